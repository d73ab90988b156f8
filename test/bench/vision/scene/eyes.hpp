#pragma once

#include <Eigen/Core>
#include <array>

#include "common/geometry.hpp"
#include "head/core/camera/camera_model.hpp"
#include "world/core/render/lighting.hpp"

namespace priamos::bench {

/// Both cameras as they really are, for asking what they see of the world. Keeps references.
struct Eyes {
  const std::array<head::CameraModel, 2>& cameras;
  const world::Lighting& scene;
  Pose2 map_from_base;
  double border_px;

  /// Whether a point of the base frame is within both pictures, so far from their borders.
  bool InPicture(const Eigen::Vector3d& in_base, double border) const;
  /// Whether nothing stands before it, as seen by both.
  bool Visible(const Eigen::Vector3d& in_base) const;
  /// How far behind a point the left camera sees the surface there [m]; negative: before it.
  double SurfaceBehind(const Eigen::Vector3d& in_base) const;
};

}  // namespace priamos::bench
