#include "cli/scenario/order_story.hpp"

#include <cmath>
#include <utility>

namespace priamos::cli {

OrderStory::OrderStory(const StoryStage& stage)
    : scenario_(stage.scenario),
      progress_(stage.progress),
      alive_(stage.scenario, stage.onboard, stage.offboard),
      status_(stage.offboard.SubscribeAll(channels::kMissionStatus)),
      truth_(stage.onboard.Subscribe(channels::kWorldTruth)),
      orders_(stage.offboard.Advertise(channels::kMissionCommand)) {}

void OrderStory::Tick(Time now) {
  now_ = now;
  if (!start_) start_ = now;
  alive_.Listen();
  if (ended_) return;
  if (!order_ && !alive_.Missing().empty()) {
    text_ = "no sign of life from " + alive_.Missing();
    return;
  }
  if (FindStory(scenario_.story).needs_waypoints && scenario_.waypoints.empty())
    return End(now, false, "the scenario has no waypoint");
  if (!order_) Begin(now);
  for (const mission_status_t& status : status_.Drain()) {
    if (const auto text = order_->Hear(status, now)) progress_(now, *text);
    Hear(status, now);
  }
  if (const auto message = order_->Step(now)) Publish(*message);
  text_ = order_->text();
  Follow(now);
}

void OrderStory::End(Time now, bool succeeded, std::string text) {
  progress_(now, text);
  succeeded_ = succeeded;
  text_ = std::move(text);
  ended_ = now;
}

bool OrderStory::Done(Time now) const {
  if (ended_) return now - *ended_ >= kAftermath;
  return start_ && Seconds(now - *start_) >= scenario_.time_limit_s;
}

std::string OrderStory::Reason() const {
  return ended_ || !order_ ? text_ : TimeLimitReason(scenario_, text_);
}

std::optional<double> OrderStory::DistanceFrom(const ScenarioWaypoint& waypoint) const {
  const world_truth_t* truth = truth_.get();
  if (!truth) return std::nullopt;
  return std::hypot(truth->x_m - waypoint.x_m, truth->y_m - waypoint.y_m);
}

}  // namespace priamos::cli
