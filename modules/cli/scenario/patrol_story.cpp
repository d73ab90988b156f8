#include "cli/scenario/patrol_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/geometry.hpp"

namespace priamos::cli {
namespace {

/// After the order's end the run goes on, so that the last messages are recorded.
constexpr Duration kAftermath = std::chrono::milliseconds(1500);
/// As far as GotoStory lets the base be from a place, with the map's own error.
constexpr double kNear_m = 0.45;
/// How long the robot is held in the first round.
constexpr double kPause_s = 5;
constexpr int kRounds = 2;
constexpr std::array<std::int8_t, 3> kInterventions{mission_command_t::PAUSE, mission_command_t::RESUME,
                                                    mission_command_t::CANCEL};

}  // namespace

PatrolStory::PatrolStory(const StoryStage& stage)
    : scenario_(stage.scenario),
      progress_(stage.progress),
      alive_(stage.scenario, stage.onboard, stage.offboard),
      status_(stage.offboard.SubscribeAll(channels::kMissionStatus)),
      truth_(stage.onboard.Subscribe(channels::kWorldTruth)),
      orders_(stage.offboard.Advertise(channels::kMissionCommand)) {}

void PatrolStory::Tick(Time now) {
  if (!start_) start_ = now;
  alive_.Listen();
  if (ended_) return;
  if (!order_ && !alive_.Missing().empty()) {
    text_ = "no sign of life from " + alive_.Missing();
    return;
  }
  if (scenario_.waypoints.empty()) return End(now, false, "the scenario has no waypoint");
  if (!order_) Give();
  Hear(now);
  if (const auto message = order_->Step(now)) orders_.Publish(*message);
  text_ = order_->text();
  CheckPlaces(now);
  if (!ended_) Intervene(now);
  if (!ended_ && order_->outcome() != OrderOutcome::kOpen) Conclude(now);
}

void PatrolStory::Give() {
  mission_command_t command{};
  command.mission = mission_command_t::RUN;
  command.title = fmt::format("patrol of {} places", scenario_.waypoints.size());
  for (const ScenarioWaypoint& to : scenario_.waypoints) {
    mission_step_t step{};
    step.mission = mission_command_t::GOTO;
    step.x_m = to.x_m;
    step.y_m = to.y_m;
    step.yaw_rad = WrapAngle(Radians(to.yaw_deg));
    step.turn = true;
    command.steps.push_back(step);
  }
  command.n_steps = static_cast<std::int8_t>(command.steps.size());
  order_.emplace(command, true);
}

void PatrolStory::Hear(Time now) {
  for (const mission_status_t& status : status_.Drain()) {
    if (const auto text = order_->Hear(status, now)) progress_(now, *text);
    if (intervention_) intervention_->Hear(status, now);
  }
}

/// Where the base truly is when the planner reports that a step is done.
void PatrolStory::CheckPlaces(Time now) {
  const world_truth_t* truth = truth_.get();
  for (; truth && !ended_ && n_results_ < order_->steps().size(); ++n_results_) {
    const mission_result_t& result = order_->steps()[n_results_];
    if (result.outcome != mission_result_t::DONE || result.step < 1) continue;
    const ScenarioWaypoint& to = scenario_.waypoints.at(std::size_t(result.step - 1));
    const double off_m = std::hypot(truth->x_m - to.x_m, truth->y_m - to.y_m);
    worst_m_ = std::max(worst_m_, off_m);
    ++n_places_;
    if (off_m > kNear_m)
      End(now, false,
          fmt::format("round {}: the base is {:.2f} m from waypoint {}", result.round, off_m, result.step));
  }
}

/// A pause on the way to the second place, and the end after some rounds.
void PatrolStory::Intervene(Time now) {
  if (intervention_) {
    if (const auto message = intervention_->Step(now)) orders_.Publish(*message);
    if (intervention_->outcome() == OrderOutcome::kOpen) return;
    if (intervention_->outcome() != OrderOutcome::kDone)
      return End(now, false, "the planner did not pause, resume or cancel: " + intervention_->text());
    if (n_interventions_ == 0) paused_ = now;
    ++n_interventions_;
    intervention_.reset();
  }
  const std::size_t n = scenario_.waypoints.size();
  const bool due = n_interventions_ == 0   ? n_places_ >= 1
                   : n_interventions_ == 1 ? Seconds(now - *paused_) > kPause_s
                                           : n_interventions_ == 2 && n_places_ >= kRounds * n;
  if (!due) return;
  mission_command_t command{};
  command.mission = kInterventions[n_interventions_];
  if (command.mission == mission_command_t::CANCEL) command.order_id = order_->id();
  intervention_.emplace(command, true);
}

void PatrolStory::Conclude(Time now) {
  const bool cancelled =
      order_->outcome() == OrderOutcome::kCancelled && n_places_ >= kRounds * scenario_.waypoints.size();
  End(now, cancelled,
      cancelled ? fmt::format("{} places in {} rounds, {:.2f} m off at most", n_places_, kRounds, worst_m_)
                : fmt::format("after {} places: {}: {}", n_places_, Text(order_->outcome()), order_->text()));
}

void PatrolStory::End(Time now, bool succeeded, std::string text) {
  progress_(now, text);
  succeeded_ = succeeded;
  text_ = std::move(text);
  ended_ = now;
}

bool PatrolStory::Done(Time now) const {
  if (ended_) return now - *ended_ >= kAftermath;
  return start_ && Seconds(now - *start_) >= scenario_.time_limit_s;
}

template StoryKind KindOf<PatrolStory>();

}  // namespace priamos::cli
