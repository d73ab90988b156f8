#include "cli/options/new_file.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

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

TEST_F(NewFileTest, ADeviceThatIsMemoryIsWrittenAsItIs) {
  NewFile dut("/dev/null");
  EXPECT_EQ(dut.written(), "/dev/null");
  dut.Keep();
}

TEST_F(NewFileTest, WhatIsNoFileIsRefusedAndNotWaitedFor) {
  const std::string pipe = folder_ / "pipe", link = folder_ / "link", socket_file = folder_ / "socket";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(pipe, link);
  const int socket_fd = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  socket_file.copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(bind(socket_fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const auto& [path, got] : {std::pair{pipe, "a pipe"},
                                  {link, "a pipe"},
                                  {socket_file, "a socket"},
                                  {folder_.path().string(), "a folder"},
                                  {std::string("/dev/ptmx"), "a device"}})
    try {
      NewFile dut(path);
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), path + ": expected a new file, or one to replace, got " + got);
    }
  close(socket_fd);
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
