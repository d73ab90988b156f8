#include "planner/core/path/passage_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// Sums of a slip that is forgotten after the length l, as shares of a random walk of variance 1 per metre,
/// after the distance d: of the slip, and of that sum once more.
struct SlipSums {
  double once = 0, twice = 0;
};

SlipSums SumsAfter(double d, double l) {
  const double x = d / l, kept = std::exp(-x);
  return {d - l * (1 - kept), d * d * d / 3 - l * d * d / 2 + l * l * l * (1 - kept * (1 + x))};
}

}  // namespace

void DriftModel::Describe(Archive& a) {
  a.Number("slip_length_m", slip_length_m,
           {"m", 0.01, 10, "distance after which a wheel's slip is forgotten"});
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
  const SlipSums sums = SumsAfter(d, drift.slip_length_m);
  const double yaw_walk = drift.yaw_rad_per_sqrt_m * drift.yaw_rad_per_sqrt_m;
  const double lateral_walk = drift.lateral_m_per_sqrt_m * drift.lateral_m_per_sqrt_m;
  const double bias = drift.yaw_bias_rad_per_m * drift.yaw_bias_rad_per_m;
  return {std::sqrt(std::max(0.0, now) + yaw_walk * sums.twice + lateral_walk * sums.once +
                    bias * d * d * d * d / 4),
          std::sqrt(std::max(0.0, map_covariance(2, 2)) + yaw_walk * sums.once + bias * d * d)};
}

double HalfWidthTurned(const Footprint& footprint, double heading_rad) {
  const double turn = std::min(std::abs(heading_rad), kPi / 2);
  return footprint.width_m / 2 * std::cos(turn) + footprint.length_m / 2 * std::sin(turn);
}

double GapLeft(const DoorPlan& door, const Footprint& footprint, const PassageUncertainty& uncertainty,
               double tracking_m) {
  return door.opening_width_m / 2 - HalfWidthTurned(footprint, 2 * uncertainty.heading_sigma_rad) -
         std::hypot(2 * uncertainty.lateral_sigma_m, tracking_m);
}

}  // namespace priamos::planner
