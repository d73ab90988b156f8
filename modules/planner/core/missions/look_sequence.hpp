#pragma once

#include <optional>
#include <string>

#include "common/archive.hpp"
#include "common/time.hpp"
#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

/// Limits at which looking at a door is given up.
struct LookConfig {
  double timeout_s = 5;  ///< silence after a request that counts as three failures
  int failures = 9;      ///< looks without result before giving up
  int looks = 16;        ///< looks with result before giving up

  void Describe(Archive& a);
};

/// Looks at the left and the right side of a door, in turn, one at a time: a side that cannot be seen from
/// here must not keep the robot from using the other one. Pure bookkeeping; the mission sends the requests.
class LookSequence {
 public:
  explicit LookSequence(const LookConfig& config) : config_(config) {}

  /// Forgets everything; the left side is next.
  void Reset();

  /// Whether a look may be asked for now: none is under way and the pause after a failed one is over.
  bool Ready(Time now) const { return !request_id_ && now >= not_before_; }
  Side next() const { return next_; }
  /// Looks at the same side again, for which the head need not turn, when the last look found it; with
  /// `also_lost` also when it did not.
  void StayOnSide(bool also_lost = false);
  /// A look at next() was asked for.
  void Asked(int request_id, Time now);

  /// Takes an answer; a second one, or one to another request than that under way, is ignored.
  void OnResult(const LookResult& result);
  /// The outcome of the look under way, returned once: its answer, or none within the time limit.
  std::optional<LookResult> Settle(Time now);

  /// Whether both sides were seen, or one of them three times while the other could not be.
  bool Enough() const;
  /// Whether too many looks failed.
  bool FailedTooOften() const { return failures_ >= config_.failures; }
  /// Whether too many looks failed, or too many succeeded without being good enough.
  bool Exhausted() const { return FailedTooOften() || good_[0] + good_[1] >= config_.looks; }
  int failures() const { return failures_; }
  /// Counts anew: what was tried so far says nothing about the next looks.
  void ForgetFailures() { failures_ = 0; }
  /// Side and reason of the last failure, in words.
  const std::string& trouble() const { return trouble_; }

 private:
  LookConfig config_;
  Side next_ = Side::kLeft, current_ = Side::kLeft;
  std::optional<int> request_id_;
  std::optional<LookResult> result_;
  Time asked_{}, not_before_{};
  int good_[2] = {0, 0};  ///< left, right
  bool found_ = false;    ///< by the last look
  int failures_ = 0;
  std::string trouble_;
};

/// "left" or "right".
const char* NameOf(Side side);

}  // namespace priamos::planner
