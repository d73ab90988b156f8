#include "robot/estop_memory.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "test/support/temporary_folder.hpp"

namespace priamos::robot {
namespace {

using testing::HasSubstr;

class EstopMemoryTest : public testing::Test {
 protected:
  std::string path() const { return (folder_ / "robot-state").string(); }
  LastWord Written() const { return LastWordFile(path()).Load(); }
  /// A folder in the way of the file makes every write fail.
  void Break() { std::filesystem::create_directory(path() + ".new"); }
  void Mend() { std::filesystem::remove(path() + ".new"); }
  static Time At(double s) { return FromUtime(5'000'000) + FromSeconds(s); }

  TemporaryFolder folder_;
};

TEST_F(EstopMemoryTest, OnlyAnOrderlyEndWithoutAnEstopStartsUnlatched) {
  EstopMemory first(path());
  EXPECT_EQ(first.why_latched(), "");
  first.Begin(false);
  EXPECT_THAT(EstopMemory(path()).why_latched(), HasSubstr("did not end in order"));
  first.End(false);
  EXPECT_EQ(EstopMemory(path()).why_latched(), "");
  first.End(true);
  EXPECT_THAT(EstopMemory(path()).why_latched(), HasSubstr("latched before the restart"));
}

TEST_F(EstopMemoryTest, AnEstopThatCannotBeWrittenIsTriedAgainASecondLater) {
  EstopMemory dut(path());
  dut.Begin(false);
  Break();
  EXPECT_THAT(dut.Keep(At(0)), HasSubstr("cannot be saved"));
  EXPECT_EQ(dut.Keep(At(0.9)), "") << "no try, no second alarm";
  EXPECT_THAT(dut.Keep(At(1)), HasSubstr("cannot be saved"));
  Mend();
  EXPECT_EQ(dut.Keep(At(2)), "");
  EXPECT_EQ(Written(), LastWord::kEstop);
}

TEST_F(EstopMemoryTest, WhatCannotBeForgottenIsNotReArmed) {
  EstopMemory dut(path());
  dut.Begin(true);
  Break();
  EXPECT_THAT(dut.Forget(), HasSubstr("cannot be saved"));
  EXPECT_EQ(Written(), LastWord::kEstop);
  Mend();
  EXPECT_EQ(dut.Forget(), "");
  EXPECT_EQ(Written(), LastWord::kRunning);
}

TEST_F(EstopMemoryTest, WithoutAFileNothingIsKeptAndNothingFails) {
  EstopMemory dut("");
  dut.Begin(true);
  EXPECT_EQ(dut.Keep(At(0)), "");
  EXPECT_EQ(dut.Forget(), "");
  EXPECT_EQ(dut.why_latched(), "");
}

}  // namespace
}  // namespace priamos::robot
