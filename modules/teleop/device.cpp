#include "teleop/device.hpp"

namespace priamos::teleop {

std::unique_ptr<StickDevice> MakeDevice(const TeleopConfig& config, bus::Context& context) {
  if (config.device == "serial") return MakeSerialMouse(config.spacemouse, context);
  if (config.device == "keyboard") return MakeKeyboard(config.keyboard, config.pilot.buttons);
  if (config.device == "joystick") return MakeJoystick(config.joystick);
  return MakeSpaceMouse(config.spacemouse);
}

}  // namespace priamos::teleop
