// Joystick or game pad through evdev, by the kernel's own header: it takes two structures and one ioctl.
#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "teleop/device.hpp"

namespace priamos::teleop {
namespace {

constexpr Duration kTryAgain = std::chrono::seconds(1);

class Joystick : public StickDevice {
 public:
  explicit Joystick(const JoystickConfig& config) : config_(config) {}
  ~Joystick() override { Close(); }

  Stick Poll(Time now) override {
    if (fd_ < 0 && now >= next_try_) Open(now);
    input_event event;
    while (fd_ >= 0) {
      const ssize_t n = read(fd_, &event, sizeof event);
      if (n == sizeof event) {
        Take(event);
      } else if (n < 0 && (errno == EAGAIN || errno == EINTR)) {
        break;
      } else {
        Close();  // unplugged: ENODEV, or the end of the stream
      }
    }
    // The kernel reports changes only, and reliably that a device was unplugged.
    if (fd_ >= 0) stick_.heard = now;
    return stick_;
  }
  std::string Describe() const override {
    return fd_ >= 0 ? "joystick " + config_.path : "joystick: nothing at " + config_.path;
  }

 private:
  void Open(Time now) {
    next_try_ = now + kTryAgain;
    fd_ = open(config_.path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd_ < 0) return;
    stick_ = {};
    stick_.connected = true;
    for (std::size_t i = 0; i < kAxes; ++i) ranges_[i] = RangeOf(static_cast<int>(config_.axis_codes[i]));
  }
  void Close() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
    stick_ = {};
  }
  struct Range {
    double middle = 0, half = 32767;
  };
  Range RangeOf(int code) const {
    input_absinfo info{};
    if (code < 0 || ioctl(fd_, EVIOCGABS(code), &info) < 0 || info.maximum <= info.minimum) return {};
    return {(double(info.maximum) + info.minimum) / 2, (double(info.maximum) - info.minimum) / 2};
  }
  void Take(const input_event& event) {
    if (event.type == EV_KEY) {
      const int button = event.code - config_.first_button;
      if (button < 0 || button >= 32) return;
      const std::uint32_t bit = 1u << button;
      stick_.buttons = event.value != 0 ? stick_.buttons | bit : stick_.buttons & ~bit;
    }
    if (event.type != EV_ABS) return;
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (static_cast<int>(config_.axis_codes[i]) != event.code) continue;
      const double part = (event.value - ranges_[i].middle) / ranges_[i].half * config_.axis_signs[i];
      stick_.axis[i] = std::clamp(part, -1.0, 1.0);
    }
  }

  JoystickConfig config_;
  std::array<Range, kAxes> ranges_{};
  int fd_ = -1;
  Time next_try_{};
  Stick stick_;
};

}  // namespace

std::unique_ptr<StickDevice> MakeJoystick(const JoystickConfig& config) {
  return std::make_unique<Joystick>(config);
}

}  // namespace priamos::teleop
