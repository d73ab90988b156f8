#include "robot/last_word.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <stdexcept>

#include "test/support/temporary_folder.hpp"

namespace priamos::robot {
namespace {

class LastWordTest : public testing::Test {
 protected:
  std::string path() const { return (folder_ / "robot-state").string(); }
  LastWordFile dut() const { return LastWordFile(path()); }

  TemporaryFolder folder_;
};

TEST_F(LastWordTest, TheFirstStartFindsNone) {
  EXPECT_EQ(dut().Load(), LastWord::kNone);
  EXPECT_EQ(WhyLatched(LastWord::kNone), "");
}

TEST_F(LastWordTest, EveryWordIsReadAsItWasWritten) {
  for (const LastWord word : {LastWord::kEnded, LastWord::kRunning, LastWord::kEstop}) {
    dut().Save(word);
    EXPECT_EQ(dut().Load(), word);
  }
}

TEST_F(LastWordTest, OnlyAnOrderlyEndStartsUnlatched) {
  EXPECT_EQ(WhyLatched(LastWord::kEnded), "");
  EXPECT_NE(WhyLatched(LastWord::kRunning), "");
  EXPECT_NE(WhyLatched(LastWord::kEstop), "");
}

TEST_F(LastWordTest, WhatCannotBeUnderstoodIsAnEstop) {
  for (const char* text : {"", "end", "ended ", "\xff\xfe"}) {
    std::ofstream(path()) << text;
    EXPECT_EQ(dut().Load(), LastWord::kEstop) << text;
  }
}

TEST_F(LastWordTest, AWordThatCannotBeWrittenThrowsAndIsWrittenNextTime) {
  LastWordFile file(path());
  std::filesystem::create_directory(path() + ".new");
  EXPECT_THROW(file.Save(LastWord::kEstop), std::runtime_error);
  std::filesystem::remove(path() + ".new");
  file.Save(LastWord::kEstop);
  EXPECT_EQ(file.Load(), LastWord::kEstop);
}

TEST_F(LastWordTest, AFolderThatIsNotThereIsRefusedAtTheStart) {
  EXPECT_THROW(LastWordFile((folder_ / "nowhere/robot-state").string()).Load(), std::runtime_error);
}

TEST_F(LastWordTest, WithoutAFileNothingIsKept) {
  LastWordFile file("");
  file.Save(LastWord::kEstop);
  EXPECT_EQ(file.Load(), LastWord::kNone);
}

}  // namespace
}  // namespace priamos::robot
