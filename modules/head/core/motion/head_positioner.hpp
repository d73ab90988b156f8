#pragma once

#include <optional>

#include "common/config.hpp"
#include "common/time.hpp"
#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// How the head's motors are set: backlash, waiting times.
struct PositionerConfig {
  double approach_rad = 0.004;  ///< angles are first set so far below the goal
  int approach_steps = 25;      ///< zoom and focus likewise
  double settle_s = 0.06;       ///< rest after the last movement before a picture is taken
  double repeat_s = 0.25;       ///< a command without effect is sent again
  double timeout_s = 4;         ///< a setting not reached by then is given up

  void Describe(Archive& a);
};

/// What the motors report.
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

  /// A new goal; the one before is given up.
  void MoveTo(const HeadSetting& goal, Time now);

  /// Somebody else moves the head: no goal until the next MoveTo.
  void Release() { phase_ = Phase::kIdle; }

  /// Call at every tick with the newest report, null before the first. Returns what to command, if anything.
  std::optional<HeadSetting> Step(const HeadReport* report, Time now);

  /// The head rests at the goal, and did so for the settling time.
  bool settled() const { return phase_ == Phase::kSettled; }
  /// The goal was not reached in time. No motion without a report: silence ends here, too.
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
