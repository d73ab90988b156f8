#include "planner/core/map/doorways.hpp"

#include <algorithm>

namespace priamos::planner {
namespace {

/// Beside the opening, the frame and what a place is known to; before and behind the wall, frame and rebate.
constexpr double kBeside_m = 0.2, kBefore_m = 0.25;
/// A wall of which nobody knows how thick it is.
constexpr double kThickWall_m = 0.2;
/// A leaf is so much wider than the opening at most; its hinge, and what is known of its place.
constexpr double kLeaf_m = 0.15;

}  // namespace

Doorways::Doorways(const std::vector<DoorPlan>& drawn, const std::vector<LearnedDoor>& learned) {
  for (const DoorPlan& door : drawn)
    doors_.push_back({door.map_from_door(), door.opening_width_m, door.wall_thickness_m});
  for (const LearnedDoor& door : learned)
    doors_.push_back({door.map_from_door(), door.width_m, kThickWall_m});
}

bool Doorways::Has(const LearnedObject& object) const {
  const Rectangle footprint = object.Footprint();
  return std::any_of(doors_.begin(), doors_.end(), [&](const Doorway& door) {
    return ReachesInto(footprint, door) || IsLeaf(object, door);
  });
}

bool Doorways::ReachesInto(const Rectangle& footprint, const Doorway& door) {
  const Rectangle opening{door.map_from_door,
                          {door.thickness_m / 2 + kBefore_m, door.width_m / 2 + kBeside_m}};
  return Distance(opening, footprint) <= 0;
}

/// A leaf, or the part of it that was seen, lies in the circle around its hinge that it sweeps.
bool Doorways::IsLeaf(const LearnedObject& object, const Doorway& door) {
  if (object.kind != "face") return false;
  const auto corners = object.Footprint().Corners();
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector2d hinge = door.map_from_door * Eigen::Vector2d(0, side * door.width_m / 2);
    if (std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector2d& corner) {
          return (corner - hinge).norm() <= door.width_m + door.thickness_m / 2 + kLeaf_m;
        }))
      return true;
  }
  return false;
}

}  // namespace priamos::planner
