#include "planner/core/path/swept_footprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::planner {
namespace {

/// No point of the body moves more than this between two checked poses, unless it cannot matter.
constexpr double kLeastAdvance_m = 0.005;
/// Leeway is looked for in such steps up to this; a line that is shorter than the last has none.
constexpr double kLeewayStep_m = 0.1, kMostLeeway_m = 2.0, kShort_m = 0.2;

}  // namespace

Pose2 Between(const Pose2& from, const Pose2& to, double part) {
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
          WrapAngle(from.yaw + part * WrapAngle(to.yaw - from.yaw))};
}

SweptFootprint::SweptFootprint(const Footprint& footprint, ObstacleMap obstacles)
    : footprint_(footprint),
      obstacles_(std::move(obstacles)),
      radius_m_(std::hypot(footprint.length_m, footprint.width_m) / 2) {}

double SweptFootprint::Travel(const Pose2& from, const Pose2& to) const {
  return (to.translation() - from.translation()).norm() + std::abs(WrapAngle(to.yaw - from.yaw)) * radius_m_;
}

SweptFootprint::Gap SweptFootprint::At(const Pose2& map_from_base) const {
  const auto nearest = obstacles_.NearestTo(footprint_.At(map_from_base));
  return {nearest.distance_m, std::string(nearest.name)};
}

SweptFootprint::Gap SweptFootprint::Along(const Pose2& from, const Pose2& to) const {
  const double travel_m = Travel(from, to);
  ObstacleMap::Nearest gap;
  for (double at_m = 0;;) {
    const auto nearest =
        obstacles_.NearestTo(footprint_.At(Between(from, to, travel_m > 0 ? at_m / travel_m : 1)));
    if (nearest.distance_m < gap.distance_m) gap = nearest;
    if (at_m >= travel_m || gap.distance_m <= 0) return {gap.distance_m, std::string(gap.name)};
    // The distance to an obstacle changes by no more than the body moves.
    at_m = std::min(travel_m, at_m + std::max(kLeastAdvance_m, nearest.distance_m - gap.distance_m));
  }
}

bool SweptFootprint::IsFree(const Pose2& from, const Pose2& to, double margin_m) const {
  const double travel_m = Travel(from, to);
  for (double at_m = 0;;) {
    const Pose2 pose = Between(from, to, travel_m > 0 ? at_m / travel_m : 1);
    const double distance_m = obstacles_.NearestTo(footprint_.At(pose)).distance_m;
    if (distance_m < margin_m) return false;
    if (at_m >= travel_m) return true;
    at_m = std::min(travel_m, at_m + std::max(kLeastAdvance_m, distance_m - margin_m));
  }
}

double SweptFootprint::FreeBeside(const Pose2& from, const Pose2& to, double side, double margin_m) const {
  const Eigen::Vector2d line = to.translation() - from.translation();
  if (line.norm() < kShort_m) return 0;
  const Eigen::Vector2d across = Eigen::Vector2d(-line.y(), line.x()) * (side / line.norm());
  const auto moved = [&](const Pose2& pose, double by_m) {
    return Pose2{pose.x + across.x() * by_m, pose.y + across.y() * by_m, pose.yaw};
  };
  int steps = 0;
  while ((steps + 1) * kLeewayStep_m <= kMostLeeway_m) {
    const double by_m = (steps + 1) * kLeewayStep_m;
    if (!IsFree(moved(from, by_m), moved(to, by_m), margin_m)) break;
    ++steps;
  }
  return steps * kLeewayStep_m;
}

Leeway SweptFootprint::LeewayOf(const Pose2& from, const Pose2& to, double margin_m) const {
  return {FreeBeside(from, to, 1, margin_m), FreeBeside(from, to, -1, margin_m)};
}

Refusal StandsIn(const Pose2& map_from_base, const std::string& obstacle) {
  return {fmt::format(
      "the robot stands at ({:.2f}, {:.2f}), where the map has {}; next: drive it clear by hand, or "
      "correct the map or the pose (priamos map, priamos where)",
      map_from_base.x, map_from_base.y, obstacle)};
}

}  // namespace priamos::planner
