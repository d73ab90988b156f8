// The evdev reader, fed through a named pipe: the same structures, an end of file for a pulled plug.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "teleop/device.hpp"

namespace priamos::teleop {
namespace {

class JoystickTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/joystick-XXXXXX";
    folder_ = mkdtemp(name);
    config_.path = folder_ + "/event0";
    dut_ = MakeJoystick(config_);
  }
  void TearDown() override {
    if (writer_ >= 0) close(writer_);
    std::filesystem::remove_all(folder_);
  }
  void Plug() {
    ASSERT_EQ(mkfifo(config_.path.c_str(), 0600), 0);
    // Both ends, so that opening does not wait for the reader.
    writer_ = open(config_.path.c_str(), O_RDWR | O_NONBLOCK);
    ASSERT_GE(writer_, 0);
    Poll();
  }
  void Say(int type, int code, int value) {
    input_event event{};
    event.type = static_cast<std::uint16_t>(type);
    event.code = static_cast<std::uint16_t>(code);
    event.value = value;
    ASSERT_EQ(write(writer_, &event, sizeof event), static_cast<ssize_t>(sizeof event));
    Poll();
  }
  void Poll() {
    now_ += std::chrono::seconds(2);
    stick_ = dut_->Poll(now_);
  }

  std::string folder_;
  JoystickConfig config_;
  int writer_ = -1;
  Time now_ = FromUtime(1'000'000);
  Stick stick_;
  std::unique_ptr<StickDevice> dut_;
};

TEST_F(JoystickTest, AnAbsentOneIsWaitedFor) {
  Poll();
  EXPECT_FALSE(stick_.connected);
  Plug();
  EXPECT_TRUE(stick_.connected);
}

TEST_F(JoystickTest, PushedAwayIsForward) {
  Plug();
  Say(EV_ABS, ABS_Y, -32767);
  EXPECT_EQ(stick_.axis[0], 1);
  Say(EV_ABS, ABS_X, 16384);
  EXPECT_NEAR(stick_.axis[1], -0.5, 0.001);
}

TEST_F(JoystickTest, ButtonsCountFromTheFirst) {
  Plug();
  Say(EV_KEY, config_.first_button + 2, 1);
  EXPECT_EQ(stick_.buttons, 4u);
  Say(EV_KEY, config_.first_button + 2, 0);
  EXPECT_EQ(stick_.buttons, 0u);
  Say(EV_KEY, 1, 1);
  EXPECT_EQ(stick_.buttons, 0u);
}

TEST_F(JoystickTest, AHeldStickIsNotSilent) {
  Plug();
  Say(EV_ABS, ABS_Y, -32767);
  Poll();
  EXPECT_EQ(stick_.heard, now_);
}

TEST_F(JoystickTest, APulledPlugLetsGo) {
  Plug();
  Say(EV_ABS, ABS_Y, -32767);
  close(writer_);
  writer_ = -1;
  std::filesystem::remove(config_.path);
  Poll();
  EXPECT_FALSE(stick_.connected);
  EXPECT_EQ(stick_.axis, Stick{}.axis);
}

}  // namespace
}  // namespace priamos::teleop
