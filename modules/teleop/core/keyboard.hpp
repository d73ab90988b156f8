#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "common/pilot/pilot_config.hpp"
#include "common/pilot/stick.hpp"
#include "common/time.hpp"

namespace priamos::teleop {

/// The keys, for the help line of the terminal.
inline constexpr const char* kKeyHelp =
    "w s: forward  a d: left  q e: turn  r f: up  arrows: pitch roll  SPACE: E-STOP\n"
    "m: mode  t: take over  g: range  z (hold): re-arm  others: stand  Ctrl-C: end";

/// A stick made of terminal keys. A terminal reports presses and repetitions, never a release: a key
/// counts as held for a while after its last repetition, and the dead-man is held while any driving key is.
class Keyboard {
 public:
  Keyboard(const ButtonUse& buttons, Duration hold) : buttons_(buttons), hold_(hold) {}

  void Type(char key, Time now);
  Stick At(Time now) const;

 private:
  void Drive(std::size_t axis, double sign, Time now);
  void Press(int button, Time now);
  bool Arrow(char key, Time now);

  struct Held {
    double value = 0;
    Time until{};
  };

  ButtonUse buttons_;
  Duration hold_;
  std::array<Held, kAxes> axes_{};
  std::map<int, Time> pressed_;  ///< button -> until
  std::string escape_;           ///< begun sequence of an arrow key
};

}  // namespace priamos::teleop
