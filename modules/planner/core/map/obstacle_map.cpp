#include "planner/core/map/obstacle_map.hpp"

#include <utility>

namespace priamos::planner {

ObstacleMap::ObstacleMap(const GroundPlan& plan) {
  for (const WallPlan& wall : plan.walls) Add("wall '" + wall.name + "'", wall.Shape());
  for (const DoorPlan& door : plan.doors) AddFrame(door);
  for (const NoGoPlan& area : plan.no_go) Add("no-go area '" + area.name + "'", area.Shape());
}

void ObstacleMap::Add(std::string name, const Rectangle& shape) {
  obstacles_.push_back({std::move(name), shape, shape.map_from_centre.rotation().transpose()});
}

void ObstacleMap::AddFrame(const DoorPlan& door) {
  const double middle_x = (door.FrontX() + door.BackX()) / 2, half_x = (door.BackX() - door.FrontX()) / 2;
  for (const double side : {1.0, -1.0}) {
    // From the front of the architrave to the far side of the wall, so that a plan whose walls end short of
    // the opening does not leave a gap beside the jamb.
    const Pose2 door_from_jamb{middle_x, side * (door.opening_width_m + door.frame_width_m) / 2, 0};
    Add("frame of door '" + door.name + "'",
        {door.map_from_door() * door_from_jamb, {half_x, door.frame_width_m / 2}});
  }
}

/// As Distance() of common/rectangle.hpp, with the rotation at hand.
double ObstacleMap::Obstacle::DistanceTo(const Eigen::Vector2d& in_map) const {
  const Eigen::Vector2d own = own_from_map * (in_map - shape.map_from_centre.translation());
  return (own.cwiseAbs() - shape.half_m).cwiseMax(0).norm();
}

ObstacleMap::Nearest ObstacleMap::NearestTo(const Rectangle& footprint) const {
  Nearest nearest;
  const double radius_m = footprint.half_m.norm();
  for (const Obstacle& obstacle : obstacles_) {
    const double to_middle_m = obstacle.DistanceTo(footprint.map_from_centre.translation());
    if (to_middle_m - radius_m >= nearest.distance_m) continue;
    const double distance_m = radius_m > 0 ? Distance(footprint, obstacle.shape) : to_middle_m;
    if (distance_m < nearest.distance_m) nearest = {distance_m, obstacle.name};
  }
  return nearest;
}

Eigen::AlignedBox2d ObstacleMap::Bounds() const {
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) box.extend(BoundsOf(i));
  return box;
}

Eigen::AlignedBox2d ObstacleMap::BoundsOf(std::size_t obstacle) const {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : obstacles_[obstacle].shape.Corners()) box.extend(corner);
  return box;
}

}  // namespace priamos::planner
