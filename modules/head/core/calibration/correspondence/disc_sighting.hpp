#pragma once

#include <Eigen/Core>
#include <vector>

#include "head/core/calibration/discs/disc_projection.hpp"

namespace priamos::head {

/// The viewing ray of a detection, its apparent angular radius, and the disc normals it may have.
struct Sighting {
  Eigen::Vector3d ray;                   ///< unit vector in the camera's frame, from the camera to the disc
  double angular_radius;                 ///< apparent size of the disc's major semi-axis [rad]
  std::vector<Eigen::Vector3d> normals;  ///< in the camera, towards it
};

/// Ray, size and possible normals of a disc from its ellipse, for a supposed focal length and image centre.
Sighting SightDisc(const Ellipse& e, double focal_px, const Eigen::Vector2d& centre_px);

/// Right-handed axes (normal, upward across the normal, third).
Eigen::Matrix3d NormalAxes(const Eigen::Vector3d& normal, const Eigen::Vector3d& up);

}  // namespace priamos::head
