#include "bus/host/service_notifier.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;

/// The end of a supervisor, bound to a path.
class Listener {
 public:
  explicit Listener(const std::string& path) : fd_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      ADD_FAILURE() << path << ": " << std::strerror(errno);
  }
  ~Listener() { close(fd_); }

  std::vector<std::string> Read() {
    std::vector<std::string> all;
    std::array<char, 256> text;
    for (ssize_t n; (n = recv(fd_, text.data(), text.size(), 0)) > 0;)
      all.emplace_back(text.data(), static_cast<std::size_t>(n));
    return all;
  }

 private:
  int fd_;
};

class ServiceNotifierTest : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "notify";
  const Time t0_ = FromUtime(1'000'000);
};

TEST_F(ServiceNotifierTest, ReadyOnceThenAliveFiveTimesASecond) {
  Listener listener(path_);
  ServiceNotifier dut(path_.c_str());
  for (int ms = 0; ms < 1000; ms += 20) dut.Beat(t0_ + milliseconds(ms));
  const auto said = listener.Read();
  ASSERT_EQ(said.size(), 5u);
  EXPECT_EQ(said[0], "READY=1\nWATCHDOG=1");
  EXPECT_EQ(said[4], "WATCHDOG=1");
}

TEST_F(ServiceNotifierTest, AStatusIsSentWheneverItChanges) {
  Listener listener(path_);
  ServiceNotifier dut(path_.c_str());
  dut.Beat(t0_, "at home");
  dut.Beat(t0_ + milliseconds(200), "at home");
  dut.Beat(t0_ + milliseconds(400), "away");
  const auto said = listener.Read();
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0], "READY=1\nWATCHDOG=1\nSTATUS=at home");
  EXPECT_EQ(said[1], "WATCHDOG=1");
  EXPECT_EQ(said[2], "WATCHDOG=1\nSTATUS=away");
}

/// A stopped supervisor: sd_notify of libsystemd waits here for ever, and the robot's loop with it.
TEST_F(ServiceNotifierTest, NeverWaitsForASupervisorThatDoesNotRead) {
  Listener listener(path_);
  ServiceNotifier dut(path_.c_str());
  for (int beat = 0; beat < 5000; ++beat) dut.Beat(t0_ + milliseconds(200) * beat);
  EXPECT_LT(listener.Read().size(), 5000u) << "the socket was never full: nothing was tested";
  dut.Beat(t0_ + milliseconds(200) * 5001);
  EXPECT_EQ(listener.Read(), std::vector<std::string>{"WATCHDOG=1"}) << "and goes on when it reads again";
}

TEST_F(ServiceNotifierTest, ReadyIsNotLostWhenNobodyListensYet) {
  ServiceNotifier dut(path_.c_str());
  dut.Beat(t0_);
  Listener listener(path_);
  dut.Beat(t0_ + milliseconds(20));
  EXPECT_EQ(listener.Read(), std::vector<std::string>{"READY=1\nWATCHDOG=1"});
}

TEST_F(ServiceNotifierTest, WithoutASupervisorItIsSilent) {
  for (const char* address : {static_cast<const char*>(nullptr), ""}) {
    ServiceNotifier dut(address);
    dut.Beat(t0_);
  }
  ServiceNotifier too_long(std::string(300, 'x').c_str());
  too_long.Beat(t0_);
}

}  // namespace
}  // namespace priamos::bus
