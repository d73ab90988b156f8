#include "cli/scenario/mission_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace priamos::cli {
namespace {

constexpr int kNumbers = 65535;  ///< of orders, from 1 on
// MISSION_STATUS comes twice a second, and at once when something changes.
constexpr Duration kPlannerSpeaksWithin = std::chrono::milliseconds(2000);
/// An order that the planner reported and that is in no status for so long is known there no longer.
constexpr Duration kForgottenAfter = std::chrono::milliseconds(2000);
constexpr Duration kAnswersWithin = std::chrono::milliseconds(1100);
constexpr Duration kGivesUp = std::chrono::milliseconds(5000);
/// A planner that waits for the robot's pose this long has taken the order.
constexpr Duration kWaitsForRobot = std::chrono::milliseconds(3000);

/// The end of an order as a whole; nullptr while it has none.
const mission_result_t* EndOf(int order_id, const mission_status_t& status) {
  for (const mission_result_t& result : status.results)
    if (result.order_id == order_id && result.step == 0) return &result;
  return nullptr;
}

/// How many orders are to be carried out before it; nullopt: it does not wait.
std::optional<std::size_t> OrdersBefore(int order_id, const mission_status_t& status) {
  for (std::size_t i = 0; i < status.waiting.size(); ++i)
    if (status.waiting[i].order_id == order_id) return i + (status.running ? 1 : 0);
  return std::nullopt;
}

bool IsUnderWay(int order_id, const mission_status_t& status) {
  return status.running && status.order_id == order_id;
}

OrderOutcome OutcomeOf(const mission_result_t& result) {
  switch (result.outcome) {
    case mission_result_t::DONE:
      return OrderOutcome::kDone;
    case mission_result_t::CANCELLED:
      return OrderOutcome::kCancelled;
    case mission_result_t::REFUSED:
      return OrderOutcome::kRefused;
    default:
      return OrderOutcome::kFailed;
  }
}

bool IsReported(int order_id, const mission_status_t& status) {
  return status.order_id == order_id || OrdersBefore(order_id, status) ||
         std::any_of(status.results.begin(), status.results.end(),
                     [&](const mission_result_t& result) { return result.order_id == order_id; });
}

std::string StepText(const mission_status_t& status) {
  if (status.n_steps <= 1) return status.text;
  return fmt::format("step {} of {}: {}", status.step, status.n_steps, status.text);
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

std::string_view Text(OrderOutcome outcome) {
  constexpr std::array<std::string_view, 8> kNames{"open",      "accepted", "done",    "failed",
                                                   "cancelled", "refused",  "ordered", "no answer"};
  return kNames[std::size_t(outcome)];
}

std::int32_t OrderNumber(Time now) {
  return static_cast<std::int32_t>(1 + ToUtime(now) / 1000 % kNumbers);
}

void MissionOrder::End(OrderOutcome outcome, std::string text) {
  outcome_ = outcome;
  text_ = std::move(text);
}

bool MissionOrder::IsMission() const {
  return order_.mission != mission_command_t::ABORT && order_.mission != mission_command_t::PAUSE &&
         order_.mission != mission_command_t::RESUME && order_.mission != mission_command_t::CANCEL;
}

std::optional<std::string> MissionOrder::Hear(const mission_status_t& status, Time now) {
  heard_ = now;
  last_ = status;
  if (!sent_ || outcome_ != OrderOutcome::kOpen) return std::nullopt;
  Judge(status, now);
  if (!answered_ || text_ == told_) return std::nullopt;
  told_ = text_;
  return text_;
}

void MissionOrder::Judge(const mission_status_t& status, Time now) {
  if (IsMission())
    JudgeMission(status, now);
  else
    JudgeIntervention(status, now);
}

void MissionOrder::DrawNumber() {
  do order_.order_id = static_cast<std::int32_t>(1 + numbers_() % kNumbers);
  while (last_ && IsReported(id(), *last_));
}

/// Whether somebody else drew the same number at the same time, and was heard first.
bool MissionOrder::IsAnothers(const mission_status_t& status) const {
  if (!drawn_ || order_.title.empty()) return false;
  if (status.order_id == id()) return status.title != order_.title;
  return std::any_of(status.waiting.begin(), status.waiting.end(), [&](const mission_waiting_t& waits) {
    return waits.order_id == id() && waits.title != order_.title;
  });
}

void MissionOrder::JudgeMission(const mission_status_t& status, Time now) {
  if (IsAnothers(status)) {
    DrawNumber();
    sent_.reset();
    return;
  }
  CollectSteps(status);
  if (const mission_result_t* end = EndOf(id(), status)) {
    answered_ = true;
    return End(OutcomeOf(*end), end->text);
  }
  if (IsUnderWay(id(), status)) {
    answered_ = true;
    missing_since_.reset();
    text_ = StepText(status);
    const bool waits = status.phase == mission_status_t::WAITING && now - *first_sent_ < kWaitsForRobot;
    if (!to_the_end_ && !waits) End(OrderOutcome::kAccepted, text_);
  } else if (const auto before = OrdersBefore(id(), status)) {
    answered_ = true;
    missing_since_.reset();
    text_ = fmt::format("order {} waits, {} before it", id(), *before);
    if (!to_the_end_) End(OrderOutcome::kAccepted, text_);
  } else if (answered_) {
    JudgeMissing(now);
  }
}

void MissionOrder::JudgeMissing(Time now) {
  if (!missing_since_) missing_since_ = now;
  if (now - *missing_since_ < kForgottenAfter) return;
  End(OrderOutcome::kNoAnswer,
      fmt::format("the planner no longer knows order {}: it was restarted, or ended it unseen; next: priamos "
                  "mission list",
                  id()));
}

void MissionOrder::CollectSteps(const mission_status_t& status) {
  const auto same = [](const mission_result_t& a, const mission_result_t& b) {
    return a.step == b.step && a.round == b.round;
  };
  for (const mission_result_t& result : status.results) {
    if (result.order_id != id() || result.step == 0) continue;
    if (std::none_of(steps_.begin(), steps_.end(), [&](const auto& known) { return same(known, result); }))
      steps_.push_back(result);
  }
}

void MissionOrder::JudgeIntervention(const mission_status_t& status, Time now) {
  // An abort has its answer among the results: without it a planner that carries nothing out has not heard
  // it.
  const bool is_so = order_.mission == mission_command_t::ABORT
                         ? EndOf(id(), status) != nullptr && !status.running && status.waiting.empty()
                     : order_.mission == mission_command_t::PAUSE  ? status.paused
                     : order_.mission == mission_command_t::RESUME ? !status.paused
                                                                   : EndOf(id(), status) != nullptr;
  if (!is_so) return;
  answered_ = true;
  const mission_result_t* end = EndOf(id(), status);
  text_ = end ? end->text : status.text;
  const bool brakes =
      order_.mission == mission_command_t::ABORT || order_.mission == mission_command_t::PAUSE;
  if (!brakes) return End(OrderOutcome::kDone, text_);
  if (order_.mission == mission_command_t::PAUSE)
    text_ = "pause ordered; waiting until the robot confirms it";
  if (!braking_) braking_ = now;
}

/// The planner's word is not the robot's.
void MissionOrder::AwaitStanding(Time now) {
  if (stand_.Stands(*braking_, now)) return End(OrderOutcome::kDone, DoneText());
  if (stand_.IsOverdue(*braking_, now)) End(OrderOutcome::kOrdered, stand_.WhyNot(*start_, now));
}

std::string MissionOrder::DoneText() const {
  if (order_.mission == mission_command_t::PAUSE)
    return fmt::format("paused: {}; next: priamos mission resume", stand_.How());
  return fmt::format("{}: {}", text_, stand_.How());
}

/// Why there is nothing to intervene in.
std::optional<std::string> MissionOrder::NothingToDo(const mission_status_t& status) const {
  switch (order_.mission) {
    case mission_command_t::PAUSE:
      if (status.running) return std::nullopt;
      return "no mission is under way";
    case mission_command_t::RESUME:
      if (status.paused) return std::nullopt;
      return "nothing is paused";
    case mission_command_t::CANCEL:
      if (IsUnderWay(id(), status) || OrdersBefore(id(), status)) return std::nullopt;
      return fmt::format("no order {} is under way or waits", id());
    default:
      return std::nullopt;
  }
}

std::optional<mission_command_t> MissionOrder::Step(Time now) {
  if (outcome_ != OrderOutcome::kOpen) return std::nullopt;
  if (!start_) start_ = now;
  if (now - heard_.value_or(*start_) > kPlannerSpeaksWithin) {
    End(OrderOutcome::kNoAnswer, heard_ ? "the planner fell silent" : "no planner is heard");
    return std::nullopt;
  }
  if (braking_) AwaitStanding(now);
  if (!last_ || answered_) return std::nullopt;
  if (const auto nothing = sent_ ? std::nullopt : NothingToDo(*last_)) {
    End(OrderOutcome::kRefused, *nothing);
    return std::nullopt;
  }
  return Send(now);
}

/// At once, and again while the planner does not report it.
std::optional<mission_command_t> MissionOrder::Send(Time now) {
  if (sent_ && now - *sent_ < kAnswersWithin) return std::nullopt;
  if (first_sent_ && now - *first_sent_ > kGivesUp) {
    End(OrderOutcome::kNoAnswer, "the planner did not take the order; it answers: " + last_->text);
    return std::nullopt;
  }
  if ((IsMission() || order_.mission == mission_command_t::ABORT) && order_.order_id == 0) DrawNumber();
  sent_ = now;
  if (!first_sent_) first_sent_ = now;
  mission_command_t order = order_;
  order.utime = ToUtime(now);
  return order;
}

}  // namespace priamos::cli
