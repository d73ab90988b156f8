#include "test/bench/rivals/replanning.hpp"

#include "planner/core/missions/goto_mission.hpp"
#include "planner/core/missions/path_progress.hpp"
#include "test/bench/rivals/case_path.hpp"

namespace priamos::bench {

bool Replanning::IsDue(const drive_status_t& status, const Pose2& map_from_base, Time now) {
  const planner::GotoMissionConfig mission;
  const bool blocked = status.mode == drive_status_t::BLOCKED;
  if (!blocked) blocked_since_.reset();
  if (blocked && !blocked_since_) blocked_since_ = now;
  if (status.path_id != path_.id || departures_ >= mission.retries) return false;
  if (status.mode == drive_status_t::ARRIVED)
    return (map_from_base.translation() - goal_.translation()).norm() > mission.near_m;
  return blocked && now - *blocked_since_ > FromSeconds(mission.limits.blocked_s);
}

void Replanning::AddThing(const drive_status_t& status, const Pose2& map_from_base) {
  const std::size_t next = path_.points.size() - planner::PointsLeft(path_.points, status.remaining_m).size();
  const Pose2& from = next > 0 ? path_.points[next - 1] : start_;
  const Eigen::Vector2d ahead = path_.points[next].translation() - from.translation();
  if (ahead.norm() < 0.01) return;
  std::optional<planner::ThingNear> nearest;
  if (status.nearest_m >= 0) nearest = {status.nearest_m, {status.nearest_x_m, status.nearest_y_m}};
  planner_.Add("what stopped the robot", planner::ThingMet(map_from_base, ahead.normalized(), nearest, {},
                                                           planner::GotoMissionConfig{}.thing_m));
}

std::optional<robot::Path> Replanning::Next(const drive_status_t& status, const Pose2& map_from_base,
                                            Time now) {
  if (!IsDue(status, map_from_base, now)) return std::nullopt;
  ++departures_;
  if (status.mode == drive_status_t::BLOCKED) AddThing(status, map_from_base);
  const auto found = planner_.FindPath(map_from_base, {goal_});
  if (!found) return std::nullopt;
  const planner::PlannedPath route = planner::FirstPart(*found);
  start_ = map_from_base;
  path_ = {.id = path_.id + 1, .speed_m_s = kPathSpeed_m_s, .points = route.points, .leeway = route.leeway};
  return path_;
}

}  // namespace priamos::bench
