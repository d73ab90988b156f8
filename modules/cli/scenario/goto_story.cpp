#include "cli/scenario/goto_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry.hpp"

namespace priamos::cli {
namespace {

/// After the last mission's end the run goes on, so that the last messages cross the radio and are recorded.
constexpr Duration kAftermath = std::chrono::milliseconds(1500);
/// The base may truly be so far from where it was sent: the mission's tolerance and the paper's 20 cm of a
/// pose that needs no correction; and a world's map is wrong by 10 cm and 3 degrees, 16 cm at 3 m from the
/// door.
constexpr double kNear_m = 0.45;

}  // namespace

GotoStory::GotoStory(const StoryStage& stage)
    : scenario_(stage.scenario),
      progress_(stage.progress),
      alive_(stage.scenario, stage.onboard, stage.offboard),
      status_(stage.offboard.SubscribeAll(channels::kMissionStatus)),
      truth_(stage.onboard.Subscribe(channels::kWorldTruth)),
      orders_(stage.offboard.Advertise(channels::kMissionCommand)) {}

void GotoStory::Tick(Time now) {
  if (!start_) start_ = now;
  alive_.Listen();
  if (ended_) return;
  if (!order_ && !alive_.Missing().empty()) {
    text_ = "no sign of life from " + alive_.Missing();
    return;
  }
  if (scenario_.waypoints.empty()) return End(now, false, "the scenario has no waypoint");
  if (!order_) Give(now);
  for (const auto& status : status_.Drain())
    if (const auto text = order_->Hear(status, now)) progress_(now, *text);
  if (const auto message = order_->Step(now)) orders_.Publish(*message);
  text_ = order_->text();
  if (order_->outcome() == OrderOutcome::kDone) return Arrive(now);
  if (order_->outcome() != OrderOutcome::kOpen)
    End(now, false, fmt::format("waypoint {}: {}: {}", waypoint_ + 1, Text(order_->outcome()), text_));
}

void GotoStory::Give(Time now) {
  const ScenarioWaypoint& to = scenario_.waypoints[waypoint_];
  mission_command_t command{};
  command.mission = mission_command_t::GOTO;
  command.x_m = to.x_m;
  command.y_m = to.y_m;
  command.yaw_rad = WrapAngle(Radians(to.yaw_deg));
  command.turn = true;
  order_.emplace(command, true);
  progress_(now, fmt::format("order to the planner: drive to ({:.2f}, {:.2f})", to.x_m, to.y_m));
}

void GotoStory::Arrive(Time now) {
  const ScenarioWaypoint& to = scenario_.waypoints[waypoint_];
  const world_truth_t* truth = truth_.get();
  const double off_m = truth ? std::hypot(truth->x_m - to.x_m, truth->y_m - to.y_m) : 0;
  worst_m_ = std::max(worst_m_, off_m);
  if (off_m > kNear_m)
    return End(now, false, fmt::format("the base is {:.2f} m from waypoint {}", off_m, waypoint_ + 1));
  if (++waypoint_ < scenario_.waypoints.size()) return Give(now);
  End(now, true, fmt::format("at all {} waypoints, {:.2f} m off at most", waypoint_, worst_m_));
}

void GotoStory::End(Time now, bool succeeded, std::string text) {
  progress_(now, text);
  succeeded_ = succeeded;
  text_ = std::move(text);
  ended_ = now;
}

bool GotoStory::Done(Time now) const {
  if (ended_) return now - *ended_ >= kAftermath;
  return start_ && Seconds(now - *start_) >= scenario_.time_limit_s;
}

template StoryKind KindOf<GotoStory>();

}  // namespace priamos::cli
