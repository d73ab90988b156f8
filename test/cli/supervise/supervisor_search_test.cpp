#include "cli/supervise/supervisor_search.hpp"

#include <gtest/gtest.h>

// What is heard on the buses of a robot: test/system, in a network of its own.

namespace priamos::cli {
namespace {

TEST(FoundSupervisor, OnThisComputerTheFolderIsWhatToType) {
  EXPECT_EQ(
      Describe({"pid 12 on hall9, since noon", "/var/logs"}, "hektor"),
      "robot hektor is up, but not from this folder of logs: pid 12 on hall9, since noon; its state is in "
      "/var/logs: --logs /var/logs");
}

TEST(FoundSupervisor, ElsewhereItIsWhomToAsk) {
  EXPECT_EQ(
      Describe({"pid 12 on hall9", std::nullopt}, "hektor"),
      "robot hektor is up, but not from this folder of logs: pid 12 on hall9; ask there, as the user who "
      "started it");
}

}  // namespace
}  // namespace priamos::cli
