#include "head/core/motion/head_positioner.hpp"

#include <algorithm>

namespace priamos::head {

void PositionerConfig::Describe(Archive& a) {
  a.Number("approach_rad", approach_rad,
           {"rad", 0, 0.1, "angles are first set so far below the goal: more than the play of their gears"});
  a.Integer("approach_steps", approach_steps, {"step", 0, 500, "zoom and focus likewise"});
  a.Number("settle_s", settle_s, {"s", 0, 2, "rest after the last movement before a picture is taken"});
  a.Number("repeat_s", repeat_s, {"s", 0.02, 5, "a command without effect is sent again after this time"});
  a.Number("timeout_s", timeout_s, {"s", 0.1, 60, "a setting not reached by then is given up"});
}

void HeadPositioner::MoveTo(const HeadSetting& goal, Time now) {
  if (phase_ == Phase::kSettled && IsSameSetting(goal, goal_, 1e-9)) return;
  goal_ = goal;
  started_ = now;
  phase_ = Phase::kBelow;
  must_send_ = true;
  resting_since_.reset();
}

HeadSetting HeadPositioner::Below() const {
  HeadSetting below = goal_;
  below.pan_rad -= config_.approach_rad;
  below.tilt_rad -= config_.approach_rad;
  for (int i = 0; i < 2; ++i) {
    below.vergence_rad[i] -= config_.approach_rad;
    below.zoom_step[i] = std::max(0, below.zoom_step[i] - config_.approach_steps);
    below.focus_step[i] = std::max(0, below.focus_step[i] - config_.approach_steps);
  }
  return below;
}

std::optional<HeadSetting> HeadPositioner::Send(const HeadSetting& setting, Time now) {
  if (!must_send_ && Seconds(now - sent_) < config_.repeat_s) return std::nullopt;
  must_send_ = false;
  sent_ = now;
  return setting;
}

std::optional<HeadSetting> HeadPositioner::Step(const HeadReport* report, Time now) {
  if (phase_ == Phase::kIdle || phase_ == Phase::kFailed) return std::nullopt;
  const HeadSetting target = phase_ == Phase::kBelow ? Below() : goal_;
  // Only a report younger than the command shows its effect.
  const bool resting = report && !must_send_ && report->time > sent_ && !report->moving &&
                       IsSameSetting(report->setting, target);
  if (phase_ == Phase::kSettled) {
    if (!report || resting) return std::nullopt;
    MoveTo(goal_, now);
    phase_ = Phase::kBelow;  // somebody moved it
  } else if (resting && phase_ == Phase::kBelow) {
    phase_ = Phase::kAtGoal;
    must_send_ = true;
    return Send(goal_, now);
  } else if (resting) {
    if (!resting_since_) resting_since_ = report->time;
    if (Seconds(report->time - *resting_since_) >= config_.settle_s) phase_ = Phase::kSettled;
    return std::nullopt;
  }
  resting_since_.reset();
  if (Seconds(now - started_) > config_.timeout_s) {
    phase_ = Phase::kFailed;
    return std::nullopt;
  }
  return Send(phase_ == Phase::kBelow ? Below() : goal_, now);
}

}  // namespace priamos::head
