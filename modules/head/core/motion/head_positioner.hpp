#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"
#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// Approach and waiting times of the head's motors.
struct PositionerConfig {
  double approach_rad = 0.004;  ///< distance below the goal that the angles are set to first
  int approach_steps = 25;      ///< the same distance of zoom and focus
  double settle_s = 0.06;       ///< time at rest before a picture is taken
  double repeat_s = 0.25;       ///< time after which a command without effect is sent again
  double timeout_s = 4;         ///< time after which a setting that is not reached is given up

  void Describe(Archive& a);
};

/// A report of the motors.
struct HeadReport {
  Time time;
  HeadSetting setting;
  bool moving = false;
};

/// Brings the head to a setting and reports when it rests there. Every motor arrives from below: gears have
/// play, so a setting is repeatable, and its calibration valid, only if it is always approached from the same
/// side (paper, section 3.1.5; Wilson 1993). A goal that was reached like this and not left is not approached
/// again.
class HeadPositioner {
 public:
  explicit HeadPositioner(const PositionerConfig& config) : config_(config) {}

  /// Changes approach and times, also on the way to a goal.
  void set_config(const PositionerConfig& config) { config_ = config; }
  /// A new goal; the one before is given up.
  void MoveTo(const HeadSetting& goal, Time now);

  /// Drops the goal until the next MoveTo, because somebody else moves the head.
  void Release() { phase_ = Phase::kIdle; }

  /// Setting to command now, if any. Call it at every tick with the newest report, null before the first.
  std::optional<HeadSetting> Step(const HeadReport* report, Time now);

  /// Where it was sent last.
  const HeadSetting& goal() const { return goal_; }
  /// Whether the head rests at the goal, and did so for the settling time.
  bool settled() const { return phase_ == Phase::kSettled; }
  /// Whether it is on its way to the goal, or has only just arrived.
  bool moving() const { return phase_ == Phase::kBelow || phase_ == Phase::kAtGoal; }
  /// Whether the goal was not reached in time, or no report came.
  bool failed() const { return phase_ == Phase::kFailed; }

 private:
  enum class Phase { kIdle, kBelow, kAtGoal, kSettled, kFailed };
  HeadSetting Below() const;
  std::optional<HeadSetting> Send(const HeadSetting& setting, Time now);

  PositionerConfig config_;
  Phase phase_ = Phase::kIdle;
  HeadSetting goal_;
  Time started_{}, sent_{};
  std::optional<Time> resting_since_;
  bool must_send_ = false;
};

}  // namespace priamos::head
