#include "cli/options/new_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

class NewFileTest : public testing::Test {
 protected:
  NewFileTest() { std::ofstream(path_) << "old"; }
  std::string Content() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }
  auto Files() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "out.lcmlog";
};

TEST_F(NewFileTest, TakesThePlaceOfAnOlderOneWhenItIsKept) {
  NewFile dut(path_);
  std::ofstream(dut.written()) << "new";
  EXPECT_EQ(Content(), "old");
  dut.Keep();
  EXPECT_EQ(Content(), "new");
  EXPECT_EQ(Files(), 1);
}

TEST_F(NewFileTest, WhatIsNotKeptLeavesTheOlderOneAndNothingElse) {
  {
    NewFile dut(path_);
    std::ofstream(dut.written()) << "half of the n";
  }
  EXPECT_EQ(Content(), "old");
  EXPECT_EQ(Files(), 1);
}

TEST_F(NewFileTest, WhereALinkLeadsTheLinkStays) {
  const std::string link = folder_ / "link";
  fs::create_symlink(path_, link);
  NewFile dut(link);
  std::ofstream(dut.written()) << "new";
  dut.Keep();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(Content(), "new");
}

TEST_F(NewFileTest, ADeviceIsWrittenAsItIs) {
  NewFile dut("/dev/null");
  EXPECT_EQ(dut.written(), "/dev/null");
  dut.Keep();
}

TEST_F(NewFileTest, WhereNothingCanBeWrittenItSaysSoByTheNameThatWasGiven) {
  const std::string nowhere = folder_ / "nowhere/out.lcmlog";
  try {
    NewFile dut(nowhere);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(nowhere + ": cannot be written: No such file"));
  }
}

}  // namespace
}  // namespace priamos::cli
