#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace priamos::robot {

/// An echo where the odometry puts it.
struct PlacedEcho {
  Pose2 odom_from_base, odom_from_sonar;
  double range_m = 0;
  double travel_m = 0;  ///< how far the base had driven by then

  /// The nearest point of a wall whose normal (towards the wall) is `normal`.
  Eigen::Vector2d Foot(const Eigen::Vector2d& normal) const {
    return odom_from_sonar.translation() + range_m * normal;
  }
};

}  // namespace priamos::robot
