#pragma once

#include <Eigen/Geometry>

#include "head/core/calibration/discs/disc_projection.hpp"

namespace priamos::support {

/// The ellipse with these semi-axes, the longer one turned by `angle_rad` from the u axis towards v.
inline head::Ellipse EllipseAt(const Eigen::Vector2d& centre_px, double semi_major_px, double semi_minor_px,
                               double angle_rad) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  const Eigen::Matrix2d axes =
      Eigen::Vector2d(semi_major_px * semi_major_px, semi_minor_px * semi_minor_px).asDiagonal();
  return {centre_px, turn * axes * turn.transpose()};
}

inline head::Ellipse CircleAt(double u, double v, double radius_px) {
  return EllipseAt({u, v}, radius_px, radius_px, 0);
}

}  // namespace priamos::support
