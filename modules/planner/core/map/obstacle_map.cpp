#include "planner/core/map/obstacle_map.hpp"

namespace priamos::planner {

ObstacleMap::ObstacleMap(const GroundPlan& plan) {
  for (const WallPlan& wall : plan.walls) obstacles_.push_back({"wall '" + wall.name + "'", wall.Shape()});
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
