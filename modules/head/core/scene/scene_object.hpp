#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace priamos::head {

/// What stands there, as far as its edges tell.
enum class ObjectKind {
  kEdge,  ///< an upright edge that belongs to no face
  kFace,  ///< an upright rectangle
  kBox,   ///< two faces that meet at a right angle, as a box shows them
};

/// Something that stands on the floor, or hangs above it, as one look reconstructed it. The border of a table
/// top is a low face at the height of the top, a corner of one a flat box.
struct SceneObject {
  ObjectKind kind = ObjectKind::kFace;
  Pose2 base_from_front;  ///< middle of its front on the floor; x square to it, away from the head
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of that middle, base frame [m^2]
  double sigma_yaw_rad = 0;
  double width_m = 0;  ///< of the front; an edge: 0
  double depth_m = 0;  ///< of a box, behind its front; else 0: not known
  double bottom_m = 0, top_m = 0;
};

}  // namespace priamos::head
