#include "cli/scenario/mission_order.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace priamos::cli {
namespace {

// MISSION_STATUS comes twice a second, and at once when something changes.
constexpr Duration kPlannerSpeaksWithin = std::chrono::milliseconds(2000);
constexpr Duration kAnswersWithin = std::chrono::milliseconds(1100);
constexpr Duration kGivesUp = std::chrono::milliseconds(5000);
/// A planner that waits for the robot's pose this long has taken the order.
constexpr Duration kWaitsForRobot = std::chrono::milliseconds(3000);

bool SameWords(const mission_status_t& a, const mission_status_t& b) {
  return a.phase == b.phase && a.text == b.text;
}

}  // namespace

std::string_view PhaseName(int phase) {
  constexpr std::array<std::string_view, 9> kNames{"WAITING",       "APPROACHING", "LOOKING_LEFT",
                                                   "LOOKING_RIGHT", "PASSING",     "DONE",
                                                   "FAILED",        "RETREATING",  "DRIVING"};
  return phase >= 0 && phase < int(kNames.size()) ? kNames[std::size_t(phase)] : "UNKNOWN";
}

bool IsOver(const mission_status_t& status) {
  return status.phase == mission_status_t::DONE || status.phase == mission_status_t::FAILED;
}

bool IsRunning(const mission_status_t& status) {
  return status.phase != mission_status_t::WAITING && !IsOver(status);
}

std::string_view Text(OrderOutcome outcome) {
  constexpr std::array<std::string_view, 6> kNames{"open",   "accepted", "done",
                                                   "failed", "refused",  "no answer"};
  return kNames[std::size_t(outcome)];
}

void MissionOrder::End(OrderOutcome outcome, std::string text) {
  outcome_ = outcome;
  text_ = std::move(text);
}

std::optional<std::string> MissionOrder::Hear(const mission_status_t& status, Time now) {
  heard_ = now;
  const bool is_new = sent_ && !SameWords(status, last_.value_or(*before_));
  if (!sent_) before_ = status;
  last_ = status;
  answered_ = answered_ || is_new;
  if (sent_ && outcome_ == OrderOutcome::kOpen) Judge(status, now);
  return is_new ? std::optional(status.text) : std::nullopt;
}

void MissionOrder::Judge(const mission_status_t& status, Time now) {
  // The same end twice in a row: long enough after the order it is the answer to it.
  const bool repeated = !answered_ && !aborts() && now - *first_sent_ >= kAnswersWithin;
  if (IsOver(status) && (answered_ || repeated)) {
    const bool good = aborts() || status.phase == mission_status_t::DONE;
    return End(good ? OrderOutcome::kDone : OrderOutcome::kFailed, status.text);
  }
  const bool waits = status.phase == mission_status_t::WAITING && now - *first_sent_ < kWaitsForRobot;
  if (answered_ && !aborts() && !to_the_end_ && !waits) End(OrderOutcome::kAccepted, status.text);
}

std::optional<mission_command_t> MissionOrder::Step(Time now) {
  if (outcome_ != OrderOutcome::kOpen) return std::nullopt;
  if (!start_) start_ = now;
  if (now - heard_.value_or(*start_) > kPlannerSpeaksWithin) {
    End(OrderOutcome::kNoAnswer, heard_ ? "the planner fell silent" : "no planner is heard");
    return std::nullopt;
  }
  if (!before_ || answered_) return std::nullopt;
  if (!sent_ && !aborts() && IsRunning(*before_)) {
    End(OrderOutcome::kRefused, "a mission is under way: " + before_->text);
    return std::nullopt;
  }
  return Send(now);
}

/// At once, and again while the planner's words stay what they were.
std::optional<mission_command_t> MissionOrder::Send(Time now) {
  if (sent_ && now - *sent_ < kAnswersWithin) return std::nullopt;
  if (sent_ && aborts() && !IsRunning(*last_)) {
    End(OrderOutcome::kDone, "no mission is under way");
    return std::nullopt;
  }
  if (first_sent_ && now - *first_sent_ > kGivesUp) {
    End(OrderOutcome::kNoAnswer, "the planner did not take the order; it answers: " + last_->text);
    return std::nullopt;
  }
  sent_ = now;
  if (!first_sent_) first_sent_ = now;
  mission_command_t order = order_;
  order.utime = ToUtime(now);
  return order;
}

}  // namespace priamos::cli
