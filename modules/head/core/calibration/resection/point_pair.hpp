#pragma once

#include <Eigen/Core>

namespace priamos::head {

/// A point in space [m] and its undistorted image [px].
struct PointPair {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
};

}  // namespace priamos::head
