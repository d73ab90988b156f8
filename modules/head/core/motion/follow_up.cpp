#include "head/core/motion/follow_up.hpp"

namespace priamos::head {
namespace {

/// So many looks beyond the landmark that tell nothing: those that follow will not either.
constexpr int kMostMissed = 3;

}  // namespace

void FollowConfig::Describe(Archive& a) {
  a.Number("within_m", within_m,
           {"m", 0, 5, "a driving base looks again by itself at what it found so near; 0: it does not"});
  a.Number("beyond_m", beyond_m,
           {"m", 0, 5, "nearer, these looks go to what earlier ones showed beyond it; 0: they do not"});
  a.Number("until_m", until_m, {"m", -1, 5, "and end so far behind its plane"});
  a.Number("every_s", every_s, {"s", 0, 5, "from one exposure to the next of these looks"});
  a.Number("least_m_s", least_m_s, {"m/s", 0, 1, "a base that is slower stands"});
}

void FollowUp::Answered(bool found, Time exposure) {
  answered_ = exposure;
  lost_ = !found;
  missed_ = 0;
}

void FollowUp::AnsweredBeyond(bool found, Time exposure) {
  missed_ = found ? 0 : missed_ + 1;
  answered_ = missed_ < kMostMissed ? std::optional(exposure) : std::nullopt;
  lost_ = true;  // by now it is too near
}

Following FollowUp::Due(const Approach& approach, Time now) {
  if (!answered_ || Seconds(now - *answered_) < config_.every_s) return Following::kNothing;
  answered_.reset();
  if (approach.speed_m_s <= config_.least_m_s || !IsNear(approach)) return Following::kNothing;
  if (GoesBeyond(approach)) return Following::kBeyond;
  return lost_ ? Following::kNothing : Following::kLandmark;
}

bool FollowUp::GoesBeyond(const Approach& approach) const {
  if (!approach.sees_beyond || config_.beyond_m == 0 || missed_ >= kMostMissed) return false;
  return IsNear(approach) && (lost_ || approach.ahead_m < config_.beyond_m);
}

bool FollowUp::IsNear(const Approach& approach) const {
  return approach.ahead_m < config_.within_m && approach.ahead_m >= -config_.until_m;
}

}  // namespace priamos::head
