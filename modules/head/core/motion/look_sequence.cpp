#include "head/core/motion/look_sequence.hpp"

#include <algorithm>
#include <limits>

namespace priamos::head {
void LookConfig::Describe(Archive& a) {
  a.Number("frame_timeout_s", frame_timeout_s,
           {"s", 0.05, 10, "all pictures must have come by then, or they are asked for again"});
  a.Integer("attempts", attempts, {"-", 1, 10, "exposures per look"});
  a.Number("age_limit_s", age_limit_s, {"s", 0.5, 60, "a look not answered by then is given up"});
  a.Number("near_m", near_m, {"m", 0, 10, "a look at what is nearer is followed by looks, not by glances"});
}

void LookSequence::Begin(Time now, int cameras) {
  wanted_ = cameras;
  phase_ = Phase::kSettling;
  begun_ = now;
  attempts_ = 0;
}

void LookSequence::Add(const FrameNotice& frame) {
  const bool other = phase_ == Phase::kSettling || frame.frame_id != frame_id_;
  if (exposures_ == Exposures::kRecorded && phase_ != Phase::kIdle && other) {
    frame_id_ = frame.frame_id;
    frames_ = {};
    phase_ = Phase::kExposing;
  }
  if (phase_ != Phase::kExposing || frame.frame_id != frame_id_) return;
  if (frame.camera >= 0 && frame.camera < wanted_) frames_[frame.camera] = frame;
}

bool LookSequence::HasFirst(int cameras) const {
  return std::all_of(frames_.begin(), frames_.begin() + cameras, [](const auto& f) { return f.has_value(); });
}

Frames LookSequence::frames() const {
  Frames frames;
  for (int i = 0; i < wanted_; ++i)
    if (frames_[i]) frames.push_back(*frames_[i]);
  return frames;
}

LookSequence::Action LookSequence::StepOnLog(Time now) const {
  if (phase_ == Phase::kExposing && HasFirst(wanted_)) return Action::kUseFrames;
  // A log whose head used two pictures has no third one.
  if (phase_ == Phase::kExposing && HasFirst(kPair) &&
      Seconds(now - frames_[0]->exposure) > config_.frame_timeout_s)
    return Action::kUseFrames;
  return Seconds(now - begun_) > config_.age_limit_s ? Action::kGiveUp : Action::kWait;
}

LookSequence::Action LookSequence::Step(bool head_settled, bool head_failed, Time now) {
  if (phase_ == Phase::kIdle) return Action::kWait;
  if (exposures_ == Exposures::kRecorded) return StepOnLog(now);
  if (head_failed || Seconds(now - begun_) > config_.age_limit_s) return Action::kGiveUp;
  if (phase_ == Phase::kExposing) {
    const bool late = Seconds(now - triggered_) >= config_.frame_timeout_s;
    if (!head_settled) {
      phase_ = Phase::kSettling;
    } else if (HasFirst(wanted_) || (late && HasFirst(kPair))) {
      return Action::kUseFrames;
    } else if (!late) {
      return Action::kWait;
    }
  }
  if (!head_settled) return Action::kWait;
  if (attempts_ == config_.attempts) return Action::kGiveUp;
  ++attempts_;
  frame_id_ = frame_id_ == std::numeric_limits<std::int32_t>::max() ? 1 : frame_id_ + 1;
  frames_ = {};
  triggered_ = now;
  phase_ = Phase::kExposing;
  return Action::kTrigger;
}

}  // namespace priamos::head
