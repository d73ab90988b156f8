#include "teleop/teleop_config.hpp"

namespace priamos::teleop {

void SpaceMouseConfig::Describe(Archive& a) {
  a.Text("socket", socket, "socket of spacenavd; empty: /var/run/spnav.sock or as in /etc/spnavrc");
  a.Text("port", port, "serial port of a Magellan, for device = \"serial\"");
  a.Integer("full_scale", full_scale, {"count", 10, 32767, "counts of the mouse at full deflection"});
}

void KeyboardConfig::Describe(Archive& a) {
  a.Number("hold_s", hold_s, {"s", 0.05, 1, "a key counts as held for so long after its last repetition"});
}

void JoystickConfig::Describe(Archive& a) {
  a.Text("path", path, "event device, see /dev/input/by-id");
  axis_codes.resize(6, -1);
  a.Numbers("axis_codes", axis_codes,
            {"-", -1, 63, "evdev codes for forward, left, up, roll, pitch, turn; -1: none"});
  axis_signs.resize(6, 1);
  a.Numbers("axis_signs", axis_signs, {"-", -1, 1, "their signs"});
  a.Integer("first_button", first_button, {"-", 0, 767, "evdev code of button 0"});
}

void TeleopConfig::Describe(Archive& a) {
  a.Choice("device", device, {"spacemouse", "serial", "keyboard", "joystick"},
           "spacemouse: through spacenavd; serial: a Magellan on a port of its own");
  a.Flag("show", show, "draw the stick and the robot's answer in the terminal");
  a.Number("rate_hz", rate_hz, {"Hz", 20, 500, "how often the device is looked at"});
  a.Section("pilot", pilot, "from the stick to wishes");
  a.Section("spacemouse", spacemouse, "space-mouse");
  a.Section("keyboard", keyboard, "terminal keys");
  a.Section("joystick", joystick, "evdev joystick or game pad");
}

}  // namespace priamos::teleop
