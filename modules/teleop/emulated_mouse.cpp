#include "teleop/emulated_mouse.hpp"

#include <cmath>
#include <utility>

#include "teleop/core/magellan.hpp"

namespace priamos::teleop {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(40);
constexpr std::size_t kLongestLine = 80;

}  // namespace

std::string EmulatedMouse::Hear(std::string_view bytes) {
  std::string answer;
  for (const char c : bytes) {
    if (c != '\r') {
      if (line_.size() < kLongestLine) line_ += c;
      continue;
    }
    const std::string line = std::exchange(line_, {});
    if (line == "vQ") answer += "v  MAGELLAN  Version 6.60  3D-CONTROLLER\r";
    if (line == "m3") {
      awake_ = true;
      answer += "m3\r" + MagellanKeys(last_.buttons);
    }
  }
  return answer;
}

/// The deflection with every second packet one count smaller: a hand is never quite still, and spacenavd
/// passes on only what changes.
Stick EmulatedMouse::Trembling(Stick hand) {
  trembles_ = !trembles_;
  for (double& a : hand.axis)
    if (a != 0 && trembles_) a -= std::copysign(1.0 / full_scale_, a);
  return hand;
}

std::string EmulatedMouse::Move(const Stick& hand, Time now) {
  if (!awake_) return {};
  std::string packets;
  if (hand.buttons != last_.buttons) packets += MagellanKeys(hand.buttons);
  const bool deflected = hand.axis != Stick{}.axis, was_deflected = last_.axis != Stick{}.axis;
  const bool leaves_rest = deflected && !was_deflected;
  if (leaves_rest || (deflected && now - *sent_ >= kPeriod) || (!deflected && was_deflected)) {
    packets += MagellanMotion(Trembling(hand), full_scale_);
    sent_ = now;
    last_.axis = hand.axis;
  }
  last_.buttons = hand.buttons;
  return packets;
}

}  // namespace priamos::teleop
