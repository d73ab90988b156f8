#include "planner/core/passage_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {

PassageUncertainty AtDoor(const DoorPlan& door, const Pose2& map_from_base,
                          const Eigen::Matrix3d& map_covariance) {
  const Pose2 map_from_door = door.map_from_door();
  const double way_m = std::max(0.0, -(map_from_door.Inverse() * map_from_base).x);
  const double c = std::cos(map_from_door.yaw), s = std::sin(map_from_door.yaw);
  // The lateral error is the error across the axis now plus the way still to go times the heading error.
  const Eigen::RowVector3d lateral(-s, c, way_m);
  return {std::sqrt(std::max(0.0, (lateral * map_covariance * lateral.transpose()).value())),
          std::sqrt(std::max(0.0, map_covariance(2, 2)))};
}

double HalfWidthTurned(const Footprint& footprint, double heading_rad) {
  const double turn = std::min(std::abs(heading_rad), kPi / 2);
  return footprint.width_m / 2 * std::cos(turn) + footprint.length_m / 2 * std::sin(turn);
}

double GapLeft(const DoorPlan& door, const Footprint& footprint, const PassageUncertainty& uncertainty) {
  return door.opening_width_m / 2 - HalfWidthTurned(footprint, 2 * uncertainty.heading_sigma_rad) -
         2 * uncertainty.lateral_sigma_m;
}

}  // namespace priamos::planner
