#pragma once

#include <optional>

#include "bus/context.hpp"
#include "lcmtypes/channels.hpp"
#include "robot/core/motion/drive_controller.hpp"

namespace priamos::robot {

/// Puts into the log and into HEALTH what changes about the drive: who holds the lease, what stops the base,
/// what it touched, who else commands its wheels.
class DriveReporter {
 public:
  explicit DriveReporter(bus::Context& context) : context_(context) {}

  /// Takes the state of the drive; reports what is new in it.
  void Report(const DriveState& state);
  /// Reports a touch.
  void Report(const Touch& touch);
  /// Takes a state of the wheels; reports when the drive board begins or ends to hold them because several
  /// processes command them.
  void Report(const wheel_state_t& message);

 private:
  bus::Context& context_;
  LeaseHolder holder_;
  std::optional<Condition> cause_;
  bool contested_ = false;
};

}  // namespace priamos::robot
