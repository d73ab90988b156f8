#include "planner/core/obstacle_map.hpp"

#include <cmath>

namespace priamos::planner {
namespace {

Rectangle ShapeOf(const WallPlan& wall) {
  const Eigen::Vector2d along = wall.to() - wall.from(), middle = (wall.to() + wall.from()) / 2;
  return {{middle.x(), middle.y(), std::atan2(along.y(), along.x())},
          {along.norm() / 2, wall.thickness_m / 2}};
}

}  // namespace

ObstacleMap::ObstacleMap(const GroundPlan& plan) {
  for (const WallPlan& wall : plan.walls) obstacles_.push_back({"wall '" + wall.name + "'", ShapeOf(wall)});
  for (const DoorPlan& door : plan.doors) AddFrame(door);
}

void ObstacleMap::AddFrame(const DoorPlan& door) {
  const double middle_x = (door.FrontX() + door.BackX()) / 2, half_x = (door.BackX() - door.FrontX()) / 2;
  for (const double side : {1.0, -1.0}) {
    // From the front of the architrave to the far side of the wall, so that a plan whose walls end short of
    // the opening does not leave a gap beside the jamb.
    const Pose2 door_from_jamb{middle_x, side * (door.opening_width_m + door.frame_width_m) / 2, 0};
    obstacles_.push_back({"frame of door '" + door.name + "'",
                          {door.map_from_door() * door_from_jamb, {half_x, door.frame_width_m / 2}}});
  }
}

ObstacleMap::Nearest ObstacleMap::NearestTo(const Rectangle& footprint) const {
  Nearest nearest;
  for (const Obstacle& obstacle : obstacles_) {
    const double distance_m = Distance(footprint, obstacle.shape);
    if (distance_m < nearest.distance_m) nearest = {distance_m, obstacle.name};
  }
  return nearest;
}

}  // namespace priamos::planner
