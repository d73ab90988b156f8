#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/pilot/pilot_config.hpp"

namespace priamos::teleop {

/// The space-mouse: through spacenavd, or raw on a serial port.
struct SpaceMouseConfig {
  std::string socket;  ///< socket of spacenavd; empty: libspnav's default
  std::string port = "/dev/ttyS0";
  int full_scale = 350;  ///< counts at full deflection

  void Describe(Archive& a);
};

/// Keys of a terminal, which report no release: a key counts as held for `hold_s`.
struct KeyboardConfig {
  double hold_s = 0.25;

  void Describe(Archive& a);
};

/// A joystick or game pad of the kernel's evdev interface.
struct JoystickConfig {
  std::string path = "/dev/input/by-id/joystick";
  /// Codes of evdev (linux/input-event-codes.h) for the axes forward, left, up, roll, pitch, turn; -1 for
  /// none.
  std::vector<double> axis_codes{1, 0, -1, -1, -1, 3};
  /// Evdev axes grow to the right and towards the operator.
  std::vector<double> axis_signs{-1, -1, 1, 1, 1, -1};
  int first_button = 304;  ///< evdev code of button 0: BTN_SOUTH of a game pad, 288 BTN_TRIGGER of a stick

  void Describe(Archive& a);
};

/// Contents of `config/<deployment>/teleop.toml`.
struct TeleopConfig {
  std::string device = "spacemouse";
  bool show = false;
  double rate_hz = 100;
  PilotConfig pilot;
  SpaceMouseConfig spacemouse;
  KeyboardConfig keyboard;
  JoystickConfig joystick;

  void Describe(Archive& a);
};

}  // namespace priamos::teleop
