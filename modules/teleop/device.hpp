#pragma once

#include <memory>
#include <string>

#include "bus/context.hpp"
#include "common/pilot/stick.hpp"
#include "teleop/teleop_config.hpp"

namespace priamos::teleop {

/// Input device that an operator holds in the hand. Never blocks.
class StickDevice {
 public:
  virtual ~StickDevice() = default;
  /// Reads what has come. A device that is gone is not connected, and is looked for again.
  virtual Stick Poll(Time now) = 0;
  /// Text for the operator: which device, and what is wrong with it.
  virtual std::string Describe() const = 0;
};

/// The device that the configuration names. Throws std::runtime_error with one sentence when it can never be
/// there; one that is merely absent now is waited for.
std::unique_ptr<StickDevice> MakeDevice(const TeleopConfig& config, bus::Context& context);

std::unique_ptr<StickDevice> MakeSpaceMouse(const SpaceMouseConfig& config);
std::unique_ptr<StickDevice> MakeSerialMouse(const SpaceMouseConfig& config, bus::Context& context);
std::unique_ptr<StickDevice> MakeKeyboard(const KeyboardConfig& config, const ButtonUse& buttons);
std::unique_ptr<StickDevice> MakeJoystick(const JoystickConfig& config);

}  // namespace priamos::teleop
