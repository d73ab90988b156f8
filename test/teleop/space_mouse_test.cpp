// The real spacenavd with an emulated Magellan on a pseudo terminal, through libspnav.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include "bus/clocks/clock.hpp"
#include "teleop/device.hpp"
#include "teleop/emulated_mouse.hpp"

namespace priamos::teleop {
namespace {

namespace fs = std::filesystem;
constexpr const char* kDaemon = "/usr/bin/spacenavd";

class SpaceMouseTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kDaemon)) GTEST_SKIP() << "no spacenavd";
    char name[] = "/tmp/space-mouse-XXXXXX";
    folder_ = mkdtemp(name);
    fs::create_directories(folder_ + "/run");
    termios raw{};
    cfmakeraw(&raw);
    char tty[128];
    ASSERT_EQ(openpty(&master_, &slave_, tty, &raw, nullptr), 0);
    fcntl(master_, F_SETFL, O_NONBLOCK);
    fcntl(master_, F_SETFD, FD_CLOEXEC);
    fcntl(slave_, F_SETFD, FD_CLOEXEC);
    std::ofstream(folder_ + "/spnavrc") << "serial = " << tty << "\nled = off\n";
    daemon_ = fork();
    if (daemon_ == 0) {
      if (chdir(folder_.c_str()) != 0) _exit(1);
      execl(kDaemon, kDaemon, "-d", "-c", "spnavrc", "-l", "log", nullptr);
      _exit(1);
    }
    SpaceMouseConfig config;
    config.socket = folder_ + "/run/spnav.sock";
    dut_ = MakeSpaceMouse(config);
  }
  void TearDown() override {
    dut_.reset();
    KillDaemon();
    Unplug();
    if (!folder_.empty()) fs::remove_all(folder_);
  }
  void KillDaemon() {
    if (daemon_ <= 0) return;
    kill(daemon_, SIGKILL);
    waitpid(daemon_, nullptr, 0);
    daemon_ = 0;
  }
  void Unplug() {
    if (master_ >= 0) {
      close(master_);
      close(slave_);
    }
    master_ = slave_ = -1;
  }

  /// Mouse, daemon and device work until `done`, at most 8 s.
  bool Until(const std::function<bool()>& done) {
    const Time end = clock_.Now() + std::chrono::seconds(8);
    while (clock_.Now() < end) {
      if (master_ >= 0) MoveMouse();
      stick_ = dut_->Poll(clock_.Now());
      if (done()) return true;
      usleep(5'000);
    }
    return false;
  }
  void MoveMouse() {
    char bytes[256];
    const ssize_t n = read(master_, bytes, sizeof bytes);
    const std::string said =
        mouse_.Hear({bytes, n > 0 ? static_cast<std::size_t>(n) : 0}) + mouse_.Move(hand_, clock_.Now());
    EXPECT_EQ(write(master_, said.data(), said.size()), static_cast<ssize_t>(said.size()));
  }
  bool Silent(double seconds) const { return Seconds(clock_.Now() - stick_.heard) > seconds; }

  bus::MonotonicClock clock_;
  std::string folder_;
  int master_ = -1, slave_ = -1;
  pid_t daemon_ = 0;
  EmulatedMouse mouse_{350};
  Stick hand_, stick_;
  std::unique_ptr<StickDevice> dut_;
};

TEST_F(SpaceMouseTest, DeliversHandAndKeysAndFallsSilentWhenUnplugged) {
  ASSERT_TRUE(Until([&] { return stick_.connected && mouse_.awake(); })) << dut_->Describe();
  // Every axis comes through the daemon as the hand moves it.
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    hand_ = {};
    hand_.axis[axis] = 0.5;
    EXPECT_TRUE(Until([&] { return std::abs(stick_.axis[axis] - 0.5) < 0.01; })) << kAxisNames[axis];
    for (std::size_t other = 0; other < kAxes; ++other)
      EXPECT_TRUE(other == axis || stick_.axis[other] == 0)
          << kAxisNames[axis] << " moved " << kAxisNames[other];
  }
  for (const int key : {0, 2, 5}) {
    hand_.buttons = 1u << key;
    EXPECT_TRUE(Until([&] { return stick_.buttons == 1u << key; })) << key;
  }
  // A held cap keeps talking; a cable that is pulled is silence.
  EXPECT_FALSE(Until([&, begin = clock_.Now()] {
                 return Silent(0.15) || clock_.Now() - begin > std::chrono::milliseconds(400);
               }) &&
               Silent(0.15));
  Unplug();
  EXPECT_TRUE(Until([&] { return Silent(0.15); }));
  KillDaemon();
  EXPECT_TRUE(Until([&] { return !stick_.connected; }));
  EXPECT_EQ(stick_.axis, Stick{}.axis);
  EXPECT_THAT(dut_->Describe(), testing::HasSubstr("no spacenavd"));
}

}  // namespace
}  // namespace priamos::teleop
