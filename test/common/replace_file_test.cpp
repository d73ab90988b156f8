#include "common/replace_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

struct ReplaceFileTest : testing::Test {
  std::string Content() const {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  TemporaryFolder folder;
  std::string path = (folder / "state").string();
};

TEST_F(ReplaceFileTest, TheWholeIsReplacedAndNothingElseIsLeft) {
  for (const bool durable : {false, true}) {
    ASSERT_TRUE(ReplaceFile(path, "a longer content", durable, 0600));
    ASSERT_TRUE(ReplaceFile(path, "short", durable, 0600));
    EXPECT_EQ(Content(), "short");
  }
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  EXPECT_FALSE(std::filesystem::exists(path + ".new"));
  EXPECT_TRUE(SyncFile(path));
}

TEST_F(ReplaceFileTest, AFailureIsToldWithItsReasonAndLeavesTheOldContent) {
  ASSERT_TRUE(ReplaceFile(path, "old", true, 0600));
  std::filesystem::create_directory(path + ".new");
  EXPECT_FALSE(ReplaceFile(path, "new", true, 0600));
  EXPECT_EQ(errno, EISDIR);
  EXPECT_EQ(Content(), "old");
  EXPECT_FALSE(SyncFile(path + ".absent"));
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace priamos
