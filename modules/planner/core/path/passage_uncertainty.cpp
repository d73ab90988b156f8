#include "planner/core/path/passage_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {

void DriftModel::Describe(Archive& a) {
  a.Number("yaw_rad_per_sqrt_m", yaw_rad_per_sqrt_m, {"rad/sqrt(m)", 0, 0.2, "random walk of the heading"});
  a.Number("lateral_m_per_sqrt_m", lateral_m_per_sqrt_m, {"m/sqrt(m)", 0, 0.2, "random walk sideways"});
  a.Number("yaw_bias_rad_per_m", yaw_bias_rad_per_m, {"rad/m", 0, 0.2, "constant turn that nobody knows"});
}

PassageUncertainty AtDoor(const DoorPlan& door, const Pose2& map_from_base,
                          const Eigen::Matrix3d& map_covariance, const DriftModel& drift) {
  const Pose2 map_from_door = door.map_from_door();
  const double d = std::max(0.0, -(map_from_door.Inverse() * map_from_base).x);
  const double c = std::cos(map_from_door.yaw), s = std::sin(map_from_door.yaw);
  // The lateral error is the error across the axis now plus the distance still to go times the heading error.
  const Eigen::RowVector3d lateral(-s, c, d);
  const double now = (lateral * map_covariance * lateral.transpose()).value();
  // A heading that walks randomly over the distance d moves the base sideways by sigma sqrt(d^3 / 3).
  const double yaw_walk = drift.yaw_rad_per_sqrt_m * drift.yaw_rad_per_sqrt_m;
  const double lateral_walk = drift.lateral_m_per_sqrt_m * drift.lateral_m_per_sqrt_m;
  const double bias = drift.yaw_bias_rad_per_m * drift.yaw_bias_rad_per_m;
  return {
      std::sqrt(std::max(0.0, now) + yaw_walk * d * d * d / 3 + lateral_walk * d + bias * d * d * d * d / 4),
      std::sqrt(std::max(0.0, map_covariance(2, 2)) + yaw_walk * d + bias * d * d)};
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
