#include "planner/core/missions/look_sequence.hpp"

#include <algorithm>
#include <utility>

namespace priamos::planner {
namespace {

/// Pause before the next look after a failed one: the view has changed by some centimetres then. A landmark
/// model takes most of a second on the radio, and a look request would overtake it.
constexpr Duration kPause = std::chrono::milliseconds(300), kModelPause = std::chrono::milliseconds(1200);
/// A head that does not answer at all is not worth as many tries as one that cannot see.
constexpr int kSilenceWeight = 3;
/// Looks at one side that make up for the other side.
constexpr int kOneSided = 3;

}  // namespace

void LookConfig::Describe(Archive& a) {
  a.Number("timeout_s", timeout_s, {"s", 0.5, 60, "silence that counts as three failed looks"});
  a.Integer("failures", failures, {"-", 1, 100, "looks without result before giving up"});
  a.Integer("looks", looks, {"-", 2, 100, "looks with result before giving up"});
}

const char* NameOf(Side side) {
  return side == Side::kLeft ? "left" : "right";
}

void LookSequence::Reset() {
  *this = LookSequence(config_);
}

void LookSequence::StayOnSide(bool also_lost) {
  if (found_ || also_lost) next_ = current_;
}

void LookSequence::Asked(int request_id, Time now) {
  current_ = next_;
  next_ = current_ == Side::kLeft ? Side::kRight : Side::kLeft;
  request_id_ = request_id;
  result_.reset();
  asked_ = now;
}

void LookSequence::OnResult(const LookResult& result) {
  // The head's "not found" is followed by the robot's "not applied": the first answer counts.
  if (request_id_ == result.request_id && !result_) result_ = result;
}

std::optional<LookResult> LookSequence::Settle(Time now) {
  if (!request_id_) return std::nullopt;
  const bool silent = !result_ && Seconds(now - asked_) > config_.timeout_s;
  if (silent) result_ = LookResult{*request_id_, false, "no answer", true};
  if (!result_) return std::nullopt;
  request_id_.reset();
  found_ = result_->ok;
  if (found_) {
    ++good_[current_ == Side::kRight];
  } else {
    failures_ += silent ? kSilenceWeight : 1;
    not_before_ = now + (result_->no_model ? kModelPause : kPause);
    trouble_ = std::string(NameOf(current_)) + " side of the door not found: " + result_->reason;
  }
  return std::exchange(result_, std::nullopt);
}

bool LookSequence::Enough() const {
  return (good_[0] > 0 && good_[1] > 0) || std::max(good_[0], good_[1]) >= kOneSided;
}

}  // namespace priamos::planner
