#include "planner/core/missions/door_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/core/map/door_sides.hpp"

namespace priamos::planner {
namespace {

/// Doors nearer to each other, and turned less, could be taken for each other from a place that is known to
/// some decimetres.
constexpr double kAlike_m = 1.0, kAlike_rad = 0.6;
/// Places before a door from which both jambs are seen: along its axis and beside it.
constexpr double kBefore_m[] = {2.0, 1.7, 2.4, 1.4, 1.25}, kBeside_m[] = {0, 0.4, -0.4};
/// Facing it where there is room, else along its wall: the head turns.
constexpr double kTurned_rad[] = {0, kPi / 2, -kPi / 2};

bool AreAlike(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kAlike_m &&
         std::abs(WrapAngle(a.yaw - b.yaw)) < kAlike_rad;
}

}  // namespace

DoorViews::DoorViews(const RoutePlannerConfig& config, const Footprint& footprint, const GroundPlan& plan)
    : planner_(config, footprint, plan), doors_(DoorSides(plan)) {}

bool DoorViews::TellsApart(const DoorPlan& door, const Pose2& place, const std::vector<Pose2>& others) const {
  const Pose2 base_from_door = place.Inverse() * door.map_from_door();
  return std::none_of(others.begin(), others.end(), [&](const Pose2& other) {
    const Pose2 there = other * base_from_door;
    return std::any_of(doors_.begin(), doors_.end(),
                       [&](const DoorPlan& d) { return AreAlike(d.map_from_door(), there); });
  });
}

std::optional<PlannedPath> DoorViews::WayBefore(const DoorPlan& door, const Pose2& place) const {
  for (const double turned_rad : kTurned_rad)
    for (const double before_m : kBefore_m)
      for (const double beside_m : kBeside_m) {
        const Pose2 there = door.map_from_door() * Pose2{-before_m, beside_m, turned_rad};
        if (!planner_.IsFree(there)) continue;
        // Where one of these places cannot be reached, its neighbours cannot either.
        return planner_.FindPath(place, {there, true});
      }
  return std::nullopt;
}

std::optional<DoorView> DoorViews::Nearest(const Pose2& place, const std::vector<Pose2>& others,
                                           const std::vector<int>& seen) const {
  std::optional<DoorView> nearest;
  double length_m = std::numeric_limits<double>::infinity();
  for (const DoorPlan& door : doors_) {
    const double straight_m = (door.map_from_door().translation() - place.translation()).norm() - 2.5;
    if (straight_m >= length_m || std::count(seen.begin(), seen.end(), door.id) > 0) continue;
    if (!TellsApart(door, place, others)) continue;
    auto path = WayBefore(door, place);
    if (!path || LengthOf(place, path->points) >= length_m) continue;
    length_m = LengthOf(place, path->points);
    nearest = DoorView{door, std::move(*path)};
  }
  return nearest;
}

}  // namespace priamos::planner
