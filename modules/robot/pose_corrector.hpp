#pragma once

#include <optional>

#include "bus/context.hpp"
#include "lcmtypes/channels.hpp"
#include "robot/core/motion/drive_controller.hpp"
#include "robot/core/pose/localiser.hpp"
#include "robot/robot_config.hpp"

namespace priamos::robot {

/// Corrects the pose by what comes over the bus, the head's fixes and a person's POSE_RESET, and answers each
/// with a POSE_CORRECTION.
class PoseCorrector {
 public:
  PoseCorrector(const RobotConfig& config, bus::Context& context);

  /// Takes what has come. An order to set the pose is refused while the base moves, and ends the path that
  /// `drive` has driven.
  void Tick(Localiser& localiser, DriveController& drive, Time now);

 private:
  void TakeFixes(Localiser& localiser, Time now);
  void AnswerFixes(Localiser& localiser, Time now);
  void TakeResets(Localiser& localiser, DriveController& drive, Time now);
  int SetPose(const pose_reset_t& order, Localiser& localiser, DriveController& drive, Time now,
              Pose2& change);

  double max_age_s_;
  bus::Context& context_;
  std::optional<pose_correction_t> placed_;  ///< the answer to the newest order to set the pose
  bus::Inbox<landmark_fix_t> fixes_;
  bus::Inbox<pose_reset_t> resets_;
  bus::Publisher<pose_correction_t> correction_;
};

}  // namespace priamos::robot
