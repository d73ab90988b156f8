#include "teleop/core/keyboard.hpp"

#include <algorithm>

namespace priamos::teleop {
namespace {

enum Axis : std::size_t { kForward, kLeft, kUp, kRoll, kPitch, kTurn };

}  // namespace

void Keyboard::Type(char key, Time now) {
  if (Arrow(key, now)) return;
  switch (key) {
    case 'w':
      return Drive(kForward, 1, now);
    case 's':
      return Drive(kForward, -1, now);
    case 'a':
      return Drive(kLeft, 1, now);
    case 'd':
      return Drive(kLeft, -1, now);
    case 'q':
      return Drive(kTurn, 1, now);
    case 'e':
      return Drive(kTurn, -1, now);
    case 'r':
      return Drive(kUp, 1, now);
    case 'f':
      return Drive(kUp, -1, now);
    case ' ':
      return Press(buttons_.estop, now);
    case 'm':
      return Press(buttons_.mode, now);
    case 't':
      return Press(buttons_.take_over, now);
    case 'g':
      return Press(buttons_.range, now);
    case 'z':
      return Press(buttons_.rearm, now);
    default:
      axes_ = {};
  }
}

/// Arrow keys come as ESC [ A to D.
bool Keyboard::Arrow(char key, Time now) {
  if (key == '\033') {
    escape_ = key;
    return true;
  }
  if (escape_ == "\033" && key == '[') {
    escape_ += key;
    return true;
  }
  const bool complete = escape_ == "\033[";
  escape_.clear();
  if (!complete) return false;
  if (key == 'A') Drive(kPitch, 1, now);
  if (key == 'B') Drive(kPitch, -1, now);
  if (key == 'C') Drive(kRoll, 1, now);
  if (key == 'D') Drive(kRoll, -1, now);
  return true;
}

void Keyboard::Drive(std::size_t axis, double sign, Time now) {
  axes_[axis] = {sign, now + hold_};
}

void Keyboard::Press(int button, Time now) {
  if (button >= 0) pressed_[button] = now + hold_;
  if (button == buttons_.estop) axes_ = {};
}

Stick Keyboard::At(Time now) const {
  Stick stick;
  stick.connected = true;
  stick.heard = now;  // a key that is not repeated lets go by itself
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (now > axes_[i].until || axes_[i].value == 0) continue;
    stick.axis[i] = axes_[i].value;
    stick.buttons |= 1u << buttons_.dead_man;
  }
  for (const auto& [button, until] : pressed_)
    if (now <= until) stick.buttons |= 1u << button;
  return stick;
}

}  // namespace priamos::teleop
