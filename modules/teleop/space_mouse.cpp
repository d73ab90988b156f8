// Space-mouse through libspnav and spacenavd.
#include <spnav.h>
#include <stdlib.h>
#include <sys/socket.h>

#include "teleop/core/magellan.hpp"
#include "teleop/device.hpp"

namespace priamos::teleop {
namespace {

constexpr Duration kTryAgain = std::chrono::milliseconds(250);

/// libspnav keeps its connection in globals of its own: one per process.
class SpaceMouse : public StickDevice {
 public:
  explicit SpaceMouse(const SpaceMouseConfig& config) : config_(config) {
    if (!config.socket.empty()) setenv("SPNAV_SOCKET", config.socket.c_str(), 1);
  }
  ~SpaceMouse() override { Close(); }

  Stick Poll(Time now) override {
    if (!open_ && now >= next_try_) Open(now);
    if (open_ && DaemonIsGone()) Close();
    spnav_event event;
    while (open_ && spnav_poll_event(&event) != 0) Take(event, now);
    return stick_;
  }

  std::string Describe() const override {
    if (!open_) return "space-mouse: no spacenavd";
    return stick_.connected ? "space-mouse" : "space-mouse: unplugged";
  }

 private:
  void Open(Time now) {
    next_try_ = now + kTryAgain;
    if (spnav_open() < 0) return;
    open_ = true;
    stick_ = {};
    stick_.connected = true;
    spnav_evmask(SPNAV_EVMASK_DEFAULT);
  }
  void Close() {
    if (open_) spnav_close();
    open_ = false;
    stick_ = {};
  }
  /// libspnav does not distinguish a closed connection from an idle one.
  static bool DaemonIsGone() {
    char byte = 0;
    return recv(spnav_fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }
  void Take(const spnav_event& event, Time now) {
    stick_.heard = now;
    if (event.type == SPNAV_EVENT_DEV) {
      stick_ = {};
      stick_.connected = event.dev.op == SPNAV_DEV_ADD;
    } else if (event.type == SPNAV_EVENT_BUTTON && event.button.bnum >= 0 && event.button.bnum < 32) {
      const std::uint32_t bit = 1u << event.button.bnum;
      stick_.buttons = event.button.press ? stick_.buttons | bit : stick_.buttons & ~bit;
    } else if (event.type == SPNAV_EVENT_MOTION) {
      // spacenavd turns z and the turn about it round: away from the operator.
      const auto& m = event.motion;
      stick_.axis = StickAxes({m.x, m.y, -m.z, m.rx, m.ry, -m.rz}, config_.full_scale);
    }
  }

  SpaceMouseConfig config_;
  bool open_ = false;
  Time next_try_{};
  Stick stick_;
};

}  // namespace

std::unique_ptr<StickDevice> MakeSpaceMouse(const SpaceMouseConfig& config) {
  return std::make_unique<SpaceMouse>(config);
}

}  // namespace priamos::teleop
