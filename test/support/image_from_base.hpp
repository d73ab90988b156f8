#pragma once

#include "world/core/camera/optics.hpp"

namespace priamos::world {

/// Homogeneous pinhole matrix of a camera (before distortion), third row a unit vector: image_from_base.
inline Eigen::Matrix<double, 3, 4> ImageFromBase(const TrueCamera& camera) {
  Eigen::Matrix3d k;
  k << camera.focal_px, 0, camera.centre_px.x(), 0, camera.focal_px, camera.centre_px.y(), 0, 0, 1;
  return k * camera.base_from_camera.inverse().matrix().topRows<3>();
}

}  // namespace priamos::world
