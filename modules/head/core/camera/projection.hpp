#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/image_size.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// A straight edge of space as one camera sees it, undistorted pixels, cut to the image.
struct ProjectedEdge {
  Eigen::Vector2d p, q;                   ///< ends in the image
  Eigen::Vector3d in_base_p, in_base_q;   ///< the points of space seen there, base frame [m]
  double depth_p = 1, depth_q = 1;        ///< their third homogeneous coordinates
  bool p_is_end = true, q_is_end = true;  ///< true: the end of the edge; false: the border of the image

  double length_px() const { return (q - p).norm(); }
  Eigen::Vector2d direction() const { return (q - p).normalized(); }
  Eigen::Vector2d normal() const {
    const Eigen::Vector2d d = direction();
    return {-d.y(), d.x()};
  }
  /// The point of space [m, base frame] seen at `image` (on or near the projected line).
  Eigen::Vector3d PointAt(const Eigen::Vector2d& image) const;
};

/// The image of an edge of space, cut to the part before the camera and in the image; nullopt if there is
/// none.
std::optional<ProjectedEdge> ProjectEdge(const CameraModel& camera, const ImageSize& size,
                                         const Eigen::Vector3d& from_in_base,
                                         const Eigen::Vector3d& to_in_base);

/// Jacobian of the image point by the point of space: derivative of equations 5 and 6.
Eigen::Matrix<double, 2, 3> ProjectionJacobian(const CameraModel& camera, const Eigen::Vector3d& in_base);

/// Optical centre in the base frame [m]: where all rows of the DLT matrix vanish.
Eigen::Vector3d OpticalCentre(const CameraModel& camera);

}  // namespace priamos::head
