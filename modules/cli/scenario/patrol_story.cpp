#include "cli/scenario/patrol_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/geometry.hpp"

namespace priamos::cli {
namespace {

/// How long the robot is held in the first round.
constexpr double kPause_s = 5;
constexpr int kRounds = 2;
constexpr std::array<std::int8_t, 3> kInterventions{mission_command_t::PAUSE, mission_command_t::RESUME,
                                                    mission_command_t::CANCEL};

}  // namespace

void PatrolStory::Begin(Time /*now*/) {
  mission_command_t command{};
  command.mission = mission_command_t::RUN;
  command.title = fmt::format("patrol of {} places", scenario().waypoints.size());
  for (const ScenarioWaypoint& to : scenario().waypoints) {
    mission_step_t step{};
    step.mission = mission_command_t::GOTO;
    step.x_m = to.x_m;
    step.y_m = to.y_m;
    step.yaw_rad = WrapAngle(Radians(to.yaw_deg));
    step.turn = true;
    command.steps.push_back(step);
  }
  command.n_steps = static_cast<std::int8_t>(command.steps.size());
  Give(command);
}

void PatrolStory::Hear(const mission_status_t& status, Time now) {
  if (intervention_) intervention_->Hear(status, now);
}

void PatrolStory::Follow(Time now) {
  CheckPlaces(now);
  if (!ended()) Intervene(now);
  if (!ended() && order().outcome() != OrderOutcome::kOpen) Conclude(now);
}

/// Where the base truly is when the planner reports that a step is done.
void PatrolStory::CheckPlaces(Time now) {
  for (; !ended() && n_results_ < order().steps().size(); ++n_results_) {
    const mission_result_t& result = order().steps()[n_results_];
    if (result.outcome != mission_result_t::DONE || result.step < 1) continue;
    const auto off = DistanceFrom(scenario().waypoints.at(std::size_t(result.step - 1)));
    if (!off) return;
    const double off_m = *off;
    worst_m_ = std::max(worst_m_, off_m);
    ++n_places_;
    if (off_m > kNearWaypoint_m)
      End(now, false,
          fmt::format("round {}: the base is {:.2f} m from waypoint {}", result.round, off_m, result.step));
  }
}

/// A pause on the way to the second place, and the end after some rounds.
void PatrolStory::Intervene(Time now) {
  const auto paths = paths_.Drain();
  const auto drives = drives_.Drain();
  if (intervention_) {
    for (const path_t& path : paths) intervention_->Hear(path);
    for (const drive_status_t& drive : drives) intervention_->Hear(drive, now);
    if (const auto message = intervention_->Step(now)) Publish(*message);
    if (intervention_->outcome() == OrderOutcome::kOpen) return;
    if (intervention_->outcome() != OrderOutcome::kDone)
      return End(now, false, "the planner did not pause, resume or cancel: " + intervention_->text());
    if (n_interventions_ == 0) paused_ = now;
    ++n_interventions_;
    intervention_.reset();
  }
  const std::size_t n = scenario().waypoints.size();
  const bool due = n_interventions_ == 0   ? n_places_ >= 1
                   : n_interventions_ == 1 ? Seconds(now - *paused_) > kPause_s
                                           : n_interventions_ == 2 && n_places_ >= kRounds * n;
  if (!due) return;
  mission_command_t command{};
  command.mission = kInterventions[n_interventions_];
  if (command.mission == mission_command_t::CANCEL) command.order_id = order().id();
  intervention_.emplace(command, true, std::uint32_t(n_interventions_));
}

void PatrolStory::Conclude(Time now) {
  const bool cancelled =
      order().outcome() == OrderOutcome::kCancelled && n_places_ >= kRounds * scenario().waypoints.size();
  End(now, cancelled,
      cancelled ? fmt::format("{} places in {} rounds, {:.2f} m off at most", n_places_, kRounds, worst_m_)
                : fmt::format("after {} places: {}: {}", n_places_, Text(order().outcome()), order().text()));
}

template StoryKind KindOf<PatrolStory>();

}  // namespace priamos::cli
