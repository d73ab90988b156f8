#include "cli/options/counted.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

TEST(Counted, OnlyOneIsSingular) {
  EXPECT_EQ(Counted(0, "event"), "0 events");
  EXPECT_EQ(Counted(1, "event"), "1 event");
  EXPECT_EQ(Counted(2, "event"), "2 events");
}

}  // namespace
}  // namespace priamos::cli
