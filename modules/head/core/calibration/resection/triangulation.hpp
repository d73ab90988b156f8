#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// A camera and the distorted pixel in which it sees the point.
struct Ray {
  const CameraModel* camera;
  Eigen::Vector2d image_px;
};

/// The point that the rays show: linear solution of equations 5 and 6 for X, Y, Z, weighted until it
/// minimises the image error. nullopt for fewer than two rays, rays that are (nearly) parallel, and points
/// behind a camera.
std::optional<Eigen::Vector3d> Triangulate(std::span<const Ray> rays);

}  // namespace priamos::head
