#include "common/input/regular_file.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

class RegularFileTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path_ = folder_ / "file";
};

TEST_F(RegularFileTest, IsReadUpToItsBound) {
  std::ofstream(path_) << std::string(200'000, 'x');
  const RegularFile dut(path_);
  ASSERT_TRUE(dut.open());
  EXPECT_EQ(dut.problem(), "");
  EXPECT_EQ(dut.Read(200'000), std::string(200'000, 'x'));
  EXPECT_EQ(RegularFile(path_).Read(199'999), std::nullopt);
}

TEST_F(RegularFileTest, KnowsItsPermissions) {
  std::ofstream(path_) << "";
  ASSERT_EQ(chmod(path_.c_str(), 0640), 0);
  EXPECT_EQ(RegularFile(path_).mode(), 0640U);
  EXPECT_FALSE(RegularFile(path_).is_private());
  EXPECT_EQ(RegularFile(path_).Read(10), "");
}

TEST_F(RegularFileTest, OneThatIsNotThereIsMissing) {
  EXPECT_TRUE(RegularFile(path_).missing());
  EXPECT_EQ(RegularFile(path_).problem(), "none");
  EXPECT_EQ(RegularFile(path_).Read(10), std::nullopt);
}

/// A reader of each of these would wait for somebody, or have no end.
TEST_F(RegularFileTest, NothingElseIsOpened) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(RegularFile(path_).problem(), "a pipe");
  EXPECT_EQ(RegularFile(folder_.path()).problem(), "a folder");
  EXPECT_EQ(RegularFile("/dev/zero").problem(), "a device");
  ASSERT_EQ(symlink("/dev/zero", (path_ + "-link").c_str()), 0);
  EXPECT_EQ(RegularFile(path_ + "-link").problem(), "a device");
  const std::string at = path_ + "-socket";
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  ASSERT_LT(at.size(), sizeof address.sun_path);
  std::strncpy(address.sun_path, at.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(RegularFile(at).problem(), "a socket");
  close(fd);
  EXPECT_FALSE(RegularFile(at).open());
}

}  // namespace
}  // namespace priamos
