#include "planner/core/agenda/step_runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace priamos::planner {
namespace {

const std::string kAwaitsPose = "waiting for the robot's pose";

}  // namespace

void StepRunnerConfig::Describe(Archive& a) {
  a.Number("pose_s", pose_s,
           {"s", 1, 600, "no news of the robot before anything is driven: the order fails"});
  a.Number("blackout_s", blackout_s, {"s", 1, 36000, "no news of the robot on the way: the order fails"});
  a.Number("leg_s", leg_s, {"s", 0, 60, "to start, turn and stop on a drive, for the time left"});
  a.Number("door_s", door_s, {"s", 0, 60, "for the looks at a door, for the time left"});
}

StepRunner::StepRunner(MissionTable& missions, DoorRouter& router, const AgendaKinds& kinds,
                       const AgendaSpeeds& speeds, const StepRunnerConfig& config)
    : missions_(missions), router_(router), kinds_(kinds), speeds_(speeds), config_(config) {
  missions_.TolerateSilence(config.blackout_s);
}

void StepRunner::Begin(const AgendaStep& step, Time now, bool moved) {
  step_ = step;
  legs_.reset();
  under_way_ = false;
  moved_ = moved;
  begun_ = last_tick_ = now;
  waited_s_ = silence_s_ = 0;
  doors_.clear();
  state_ = {Phase::kWaiting, kAwaitsPose};
  if (step.wait_s) state_.text = fmt::format("waiting for {:.0f} s", *step.wait_s);
}

MissionActions StepRunner::Tick(Time now) {
  if (step_ && !under_way_ && !paused_) step_->wait_s ? Wait(now) : StartLeg(now);
  last_tick_ = now;
  MissionActions actions = missions_.Tick(now);
  if (step_ && under_way_) FollowLeg(now);
  return actions;
}

void StepRunner::Wait(Time now) {
  waited_s_ += Seconds(now - last_tick_);
  if (waited_s_ >= *step_->wait_s) Finish(Phase::kDone, fmt::format("waited for {:.0f} s", *step_->wait_s));
}

bool StepRunner::IsHeard(Time now) const {
  const Heard& heard = missions_.heard();
  return heard.link_up && heard.pose && IsFresh(*heard.pose, now);
}

void StepRunner::StartLeg(Time now) {
  const bool by_doors = step_->order.kind == kinds_.go || step_->order.kind == kinds_.pass;
  if ((by_doors || moved_) && !IsHeard(now)) return AwaitRobot(now);
  if (const auto why = missions_.WhyLost(); why && by_doors)
    return Finish(Phase::kFailed, fmt::format("lost: {}; next: priamos mission locate", *why));
  if (!legs_ && by_doors) {
    auto legs = PlanLegs(step_->order, missions_.heard().pose->map_from_base);
    if (!legs) return Finish(Phase::kFailed, legs.reason());
    legs_ = std::move(*legs);
  }
  leg_begun_ = now;
  under_way_ = moved_ = true;
  missions_.Start(now, legs_ ? OrderOf(legs_->front()) : step_->order);
}

/// Between two legs a robot out of the radio's reach is waited for, as on the way.
void StepRunner::AwaitRobot(Time now) {
  const Heard& heard = missions_.heard();
  const double limit_s = moved_ ? config_.blackout_s : config_.pose_s;
  const Time since = std::max(heard.pose ? heard.pose->stamp : begun_, std::max(begun_, leg_begun_));
  if (Seconds(now - since) > limit_s)
    return Finish(Phase::kFailed, fmt::format("no pose from the robot for {:.0f} s: the radio link is {}",
                                              limit_s, heard.link_up ? "up, is the robot running?" : "down"));
  state_ = {Phase::kWaiting, kAwaitsPose};
}

void StepRunner::FollowLeg(Time now) {
  state_ = missions_.state();
  if (const auto silence_s = missions_.Silence_s(now)) {
    silence_s_ = std::max(silence_s_, *silence_s);
    state_.text =
        fmt::format("no news of the robot: the radio link is {}; it goes on as far as its path leads",
                    missions_.heard().link_up ? "up" : "down");
  }
  const auto& drive = missions_.heard().drive;
  if (missions_.running() && drive && drive->by_hand)
    state_.text = "begins when nobody drives by hand; " + state_.text;
  if (paused_ && missions_.running()) state_.text = PausedText(now);
  if (missions_.running()) return;
  if (state_.phase == Phase::kFailed || !legs_) return Finish(state_.phase, state_.text);
  if (legs_->front().door_id) doors_.push_back(router_.NameOf(*legs_->front().door_id));
  legs_->pop_front();
  under_way_ = false;
  if (legs_->empty()) return Finish(Phase::kDone, state_.text + Doors());
  state_ = {Phase::kWaiting, kAwaitsPose};
}

/// What the robot does, as far as it is known: an order to stand does not reach it in a blackout.
std::string StepRunner::PausedText(Time now) const {
  if (!IsHeard(now))
    return "pause ordered; nothing is heard from the robot: it goes on as it was told until the radio is "
           "back";
  return missions_.IsConfirmed() ? "paused: the robot holds its place; next: priamos mission resume"
                                 : "pause ordered; the robot has not confirmed it yet";
}

/// The doors of a way to a place, which has a last leg without one.
std::string StepRunner::Doors() const {
  if (doors_.empty() || step_->order.kind != kinds_.go) return "";
  return fmt::format(", through door '{}'", fmt::join(doors_, "' and door '"));
}

void StepRunner::Finish(Phase phase, std::string text) {
  if (silence_s_ > 0) text += fmt::format("; the robot was out of reach for {:.0f} s", silence_s_);
  state_ = {phase, std::move(text)};
  step_.reset();
  under_way_ = false;
}

void StepRunner::End(const std::string& reason) {
  if (!step_) return;
  if (under_way_)
    missions_.Abort(reason);
  else
    Finish(Phase::kFailed, reason);
  paused_ = false;
}

void StepRunner::Pause(Time now) {
  paused_ = true;
  missions_.Pause(now);
  if (step_ && !under_way_) state_.text = "paused; next: priamos mission resume";
}

void StepRunner::Resume(Time now) {
  paused_ = false;
  last_tick_ = now;
  missions_.Resume(now);
  if (step_ && step_->wait_s) state_.text = fmt::format("waiting for {:.0f} s", *step_->wait_s);
}

Outcome<std::deque<Leg>> StepRunner::PlanLegs(const MissionOrder& order, const Pose2& from) {
  if (order.kind == kinds_.pass) {
    const auto legs = router_.PlanThrough(from, order.landmark_id);
    return std::deque<Leg>(legs.begin(), legs.end());
  }
  const auto legs = router_.Plan(from, order.goal);
  if (!legs) return Refusal{legs.reason()};
  return std::deque<Leg>(legs->begin(), legs->end());
}

MissionOrder StepRunner::OrderOf(const Leg& leg) const {
  if (leg.door_id) return {kinds_.pass, *leg.door_id, {}};
  return {kinds_.go, 0, leg.goal};
}

double StepRunner::Takes_s(const Leg& leg) const {
  return leg.door_id ? config_.door_s + leg.length_m / speeds_.pass_m_s
                     : config_.leg_s + leg.length_m / speeds_.go_m_s;
}

std::optional<double> StepRunner::Left_s(Time now) const {
  if (!step_) return 0;
  if (step_->wait_s) return *step_->wait_s - waited_s_;
  if (!legs_) return std::nullopt;
  double left_s = 0;
  for (const Leg& leg : *legs_) left_s += Takes_s(leg);
  if (!under_way_) return left_s;
  const double gone_s = Seconds(now - leg_begun_);
  return left_s - std::min(gone_s, Takes_s(legs_->front()));
}

std::optional<StepRunner::Forecast> StepRunner::Foresee(const AgendaStep& step, const Pose2& map_from_base) {
  if (step.wait_s) return Forecast{*step.wait_s, map_from_base};
  if (step.order.kind != kinds_.go && step.order.kind != kinds_.pass) return std::nullopt;
  const auto legs = PlanLegs(step.order, map_from_base);
  if (!legs) return std::nullopt;
  Forecast forecast{0, legs->back().goal.map_from_base};
  for (const Leg& leg : *legs) forecast.takes_s += Takes_s(leg);
  return forecast;
}

}  // namespace priamos::planner
