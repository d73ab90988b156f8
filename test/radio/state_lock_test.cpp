#include "radio/state_lock.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

struct StateLockTest : testing::Test {
  StateLockTest() { std::filesystem::create_directory(shared); }
  bool NothingLeft() const { return std::filesystem::is_empty(shared); }
  TemporaryFolder folder;
  std::string shared = folder / "shm";
  std::string file = folder / "link.state";
};

TEST_F(StateLockTest, IsOfOneAtATime) {
  {
    std::optional<StateLock> first(std::in_place, file, shared);
    EXPECT_FALSE(first->in_use());
    EXPECT_TRUE(StateLock(file, shared).in_use());
    EXPECT_FALSE(StateLock(folder / "other.state", shared).in_use());
    first.reset();
    EXPECT_FALSE(StateLock(file, shared).in_use());
  }
  EXPECT_TRUE(NothingLeft());
}

TEST_F(StateLockTest, RemembersThatTheFileIsBehindUntilItIsNot) {
  {
    StateLock dut(file, shared);
    EXPECT_FALSE(dut.behind());
    EXPECT_TRUE(dut.SetBehind(true));
  }
  StateLock dut(file, shared);
  EXPECT_FALSE(dut.in_use());
  EXPECT_TRUE(dut.behind());
  EXPECT_TRUE(dut.SetBehind(false));
  EXPECT_FALSE(StateLock(file, shared).behind());
}

TEST_F(StateLockTest, WithoutSharedMemoryNothingIsKnownAndNothingNoted) {
  StateLock dut(file, folder / "none");
  EXPECT_FALSE(dut.in_use());
  EXPECT_FALSE(dut.behind());
  EXPECT_FALSE(dut.SetBehind(true));
}

}  // namespace
}  // namespace priamos::radio
