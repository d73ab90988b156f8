#pragma once

#include <Eigen/Core>
#include <span>

#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// An edge of an image, undistorted [px].
struct ImageLine {
  Eigen::Vector2d p, q;
};

/// Whether an edge of space would be in the picture, long enough, and next to none of it is there: what
/// showed it once has gone.
bool IsMissing(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const CameraModel& camera,
               std::span<const ImageLine> lines);

}  // namespace priamos::head
