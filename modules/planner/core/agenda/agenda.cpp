#include "planner/core/agenda/agenda.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/robot/mission_titles.hpp"

namespace priamos::planner {
namespace {

constexpr int kMostId = 65535;
constexpr const char* kNothingAborted = "no mission was under way; the robot is told to stand";

}  // namespace

Agenda::Agenda(MissionTable& missions, DoorRouter& router, const AgendaKinds& kinds,
               const AgendaSpeeds& speeds, const StepRunnerConfig& config)
    : missions_(missions), router_(router), kinds_(kinds), runner_(missions, router, kinds, speeds, config) {}

std::string Agenda::TitleOf(const AgendaStep& step) const {
  if (step.wait_s) return fmt::format("wait {:.0f} s", *step.wait_s);
  const Pose2& to = step.order.goal.map_from_base;
  if (step.order.kind == kinds_.go) return GotoTitle(to.x, to.y);
  if (step.order.kind == kinds_.pass) return DoorTitle(router_.NameOf(step.order.landmark_id));
  if (step.order.kind == kinds_.locate) return std::string(kLocateTitle);
  if (step.order.kind == kinds_.follow) return CorridorTitle(step.order.distance_m);
  if (step.order.kind == kinds_.explore) return std::string(kExploreTitle);
  return fmt::format("mission {}", step.order.kind);
}

/// What a message may hold, and no map reaches.
bool Agenda::IsPlace(const Pose2& pose) {
  constexpr double kFarthest_m = 100;
  return std::abs(pose.x) <= kFarthest_m && std::abs(pose.y) <= kFarthest_m && std::isfinite(pose.yaw);
}

std::optional<Refusal> Agenda::Check(const AgendaOrder& order) const {
  if (order.steps.empty()) return Refusal{"an order has at least one step"};
  if (order.steps.size() > kMostSteps)
    return Refusal{fmt::format("an order has at most {} steps, this one {}", kMostSteps, order.steps.size())};
  if (order.rounds < 0)
    return Refusal{fmt::format("an order has 0 rounds or more, this one {}", order.rounds)};
  for (const AgendaStep& step : order.steps) {
    if (!step.wait_s && !missions_.Knows(step.order.kind))
      return Refusal{fmt::format("unknown mission {}", step.order.kind)};
    if (!step.wait_s && !IsPlace(step.order.goal.map_from_base))
      return Refusal{"the goal is no place: its numbers are not finite, or beyond 100 m"};
    if (step.wait_s && !(*step.wait_s >= 0 && *step.wait_s <= 36000))
      return Refusal{"a wait has 0 to 36000 seconds"};
  }
  if (current_ && waiting_.size() >= kMostWaiting)
    return Refusal{fmt::format("{} orders wait already; next: priamos mission cancel", waiting_.size())};
  return std::nullopt;
}

bool Agenda::IsKnown(int id) const {
  const auto is_it = [&](const Given& given) { return given.order.id == id; };
  return (current_ && is_it(*current_)) || std::any_of(waiting_.begin(), waiting_.end(), is_it) ||
         std::any_of(results_.begin(), results_.end(),
                     [&](const AgendaResult& r) { return r.order_id == id; });
}

int Agenda::FreeId() {
  do last_id_ = last_id_ % kMostId + 1;
  while (IsKnown(last_id_));
  return last_id_;
}

std::optional<Refusal> Agenda::Take(AgendaOrder order, Time now) {
  if (order.id != 0 && IsKnown(order.id)) return std::nullopt;
  if (order.id == 0) order.id = FreeId();
  if (auto refusal = Check(order)) {
    Remember({order.id, 0, 0, AgendaEnd::kRefused, 0, refusal->reason});
    return refusal;
  }
  if (order.title.empty()) order.title = TitleOf(order.steps.front());
  waiting_.push_back({std::move(order), EstopWatch(missions_.heard().drive), now, now});
  ++changes_;
  if (!current_ && !paused_) BeginNext(now);
  return std::nullopt;
}

void Agenda::BeginNext(Time now) {
  current_ = std::move(waiting_.front());
  waiting_.pop_front();
  current_->begun = now;
  ending_.reset();
  round_ = 1;
  step_ = 1;
  takes_s_.assign(current_->order.steps.size(), std::nullopt);
  n_foreseen_ = 0;
  foreseen_.reset();
  BeginStep(now);
}

void Agenda::BeginStep(Time now) {
  step_begun_ = now;
  ++changes_;
  const bool moved = step_ > 1 || round_ > 1;
  runner_.Begin(current_->order.steps[std::size_t(step_ - 1)], now, moved);
  state_ = runner_.state();
}

MissionActions Agenda::Tick(Time now) {
  if (!current_ && !waiting_.empty() && !paused_) BeginNext(now);
  if (current_) CheckEstop();
  const MissionActions actions = runner_.Tick(now);
  if (!current_) return actions;
  state_ = runner_.state();
  if (!runner_.running())
    EndStep(now);
  else
    Foresee();
  return actions;
}

/// What moves after an emergency stop is for a person to order anew.
void Agenda::CheckEstop() {
  const auto& drive = missions_.heard().drive;
  if (!drive) return;
  current_->estop.Note(*drive);
  if (const auto reason = current_->estop.WhyEnds(*drive)) runner_.End(*reason);
}

void Agenda::EndStep(Time now) {
  const bool done = runner_.state().phase == Phase::kDone;
  const AgendaOrder& order = current_->order;
  const double took_s = Seconds(now - step_begun_);
  const AgendaEnd end = done ? AgendaEnd::kDone : ending_.value_or(AgendaEnd::kFailed);
  const bool only_one = order.steps.size() == 1 && order.rounds == 1;
  if (!only_one) Remember({order.id, step_, round_, end, took_s, runner_.state().text});
  takes_s_[std::size_t(step_ - 1)] = took_s;
  if (!done) {
    const std::string which =
        only_one ? "" : fmt::format("step {} ({}): ", step_, TitleOf(order.steps[std::size_t(step_ - 1)]));
    return EndOrder(end, which + runner_.state().text, now);
  }
  const bool last_step = std::size_t(step_) == order.steps.size();
  if (last_step && order.rounds != 0 && round_ >= order.rounds)
    return EndOrder(AgendaEnd::kDone,
                    only_one ? runner_.state().text
                             : fmt::format("all {} steps done{} in {:.0f} s", order.steps.size(),
                                           order.rounds > 1 ? fmt::format(", {} times,", order.rounds) : "",
                                           Seconds(now - current_->begun)),
                    now);
  step_ = last_step ? 1 : step_ + 1;
  if (last_step) round_ = round_ % 9999 + 1;
  BeginStep(now);
}

void Agenda::EndOrder(AgendaEnd end, std::string text, Time now) {
  const int id = current_->order.id;
  state_ = {end == AgendaEnd::kDone ? Phase::kDone : Phase::kFailed, text};
  Remember({id, 0, round_, end, Seconds(now - current_->begun), std::move(text)});
  last_ = std::move(current_->order);
  current_.reset();
  // A person who cancels one order wants the next one.
  if (end == AgendaEnd::kFailed) CancelWaiting(fmt::format("order {} before it failed", id));
  if (waiting_.empty()) Resume(now);  // the next order is not to be held by what held this one
}

void Agenda::CancelWaiting(const std::string& why) {
  for (const Given& given : waiting_) Remember({given.order.id, 0, 0, AgendaEnd::kCancelled, 0, why});
  waiting_.clear();
}

void Agenda::Abort(Time now, int id) {
  const bool any = current_ || !waiting_.empty();
  const std::string answer = any ? "aborted by the operator" : kNothingAborted;
  CancelWaiting("aborted by the operator");
  runner_.End("aborted by the operator");
  runner_.Stand(now);
  Resume(now);
  if (!any) state_.text = answer;
  ++changes_;
  if (id != 0 && !IsKnown(id)) Remember({id, 0, 0, AgendaEnd::kDone, 0, answer});
}

bool Agenda::Cancel(int order_id) {
  if (current_ && current_->order.id == order_id) {
    ending_ = AgendaEnd::kCancelled;
    runner_.End("cancelled by the operator");
    return true;
  }
  const auto it = std::find_if(waiting_.begin(), waiting_.end(),
                               [&](const Given& given) { return given.order.id == order_id; });
  if (it == waiting_.end()) return false;
  waiting_.erase(it);
  Remember({order_id, 0, 0, AgendaEnd::kCancelled, 0, "cancelled by the operator before it began"});
  return true;
}

bool Agenda::Pause(Time now) {
  if (!current_) return false;
  paused_ = true;
  ++changes_;
  runner_.Pause(now);
  return true;
}

bool Agenda::Resume(Time now) {
  if (!paused_) return false;
  paused_ = false;
  ++changes_;
  runner_.Resume(now);
  return true;
}

void Agenda::Remember(AgendaResult result) {
  ++changes_;
  ++n_ended_;
  results_.push_back(std::move(result));
  if (results_.size() > kMostResults) results_.pop_front();
}

std::vector<AgendaOrder> Agenda::waiting() const {
  std::vector<AgendaOrder> orders;
  for (const Given& given : waiting_) orders.push_back(given.order);
  return orders;
}

/// One step further in each time step, for a route takes a while to be found.
void Agenda::Foresee() {
  const auto& steps = current_->order.steps;
  if (n_foreseen_ >= steps.size()) return;
  if (n_foreseen_ == 0 && steps[0].order.kind == kinds_.go && !steps[0].wait_s) {
    foreseen_ = steps[0].order.goal.map_from_base;  // the runner has its way already
    ++n_foreseen_;
    return;
  }
  if (!foreseen_ && missions_.heard().pose) foreseen_ = missions_.heard().pose->map_from_base;
  if (!foreseen_) return;
  const auto forecast = runner_.Foresee(steps[n_foreseen_], *foreseen_);
  if (!forecast) {
    n_foreseen_ = steps.size();  // where the robot is after that nobody knows
    return;
  }
  takes_s_[n_foreseen_++] = forecast->takes_s;
  foreseen_ = forecast->map_from_base;
}

std::optional<double> Agenda::Left_s(Time now) const {
  if (!current_) return std::nullopt;
  std::optional<double> left_s = runner_.Left_s(now);
  for (std::size_t i = std::size_t(step_); left_s && i < takes_s_.size(); ++i)
    left_s = takes_s_[i] ? std::optional(*left_s + *takes_s_[i]) : std::nullopt;
  return left_s;
}

}  // namespace priamos::planner
