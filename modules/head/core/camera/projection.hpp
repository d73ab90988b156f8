#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/image_size.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// A straight edge of space as one camera sees it, undistorted pixels, cut to the image.
struct ProjectedEdge {
  Eigen::Vector2d p, q;                   ///< ends in the image
  Eigen::Vector3d in_base_p, in_base_q;   ///< the points of space seen there [m]
  double depth_p = 1, depth_q = 1;        ///< their third homogeneous coordinates
  bool p_is_end = true, q_is_end = true;  ///< an end of the edge, not the border of the image

  double length_px() const { return (q - p).norm(); }
  Eigen::Vector2d direction() const { return (q - p).normalized(); }
  Eigen::Vector2d normal() const {
    const Eigen::Vector2d d = direction();
    return {-d.y(), d.x()};
  }
  /// The point of space [m, base frame] seen at `image` (on or near the projected line).
  Eigen::Vector3d PointAt(const Eigen::Vector2d& image) const;
};

/// One edge of space, cut to what lies before the camera and in the image; nullopt if nothing does.
std::optional<ProjectedEdge> ProjectEdge(const CameraModel& camera, const ImageSize& size,
                                         const Eigen::Vector3d& from_in_base,
                                         const Eigen::Vector3d& to_in_base);

/// Change of the image point by a change of the point of space: derivative of equations 5 and 6.
Eigen::Matrix<double, 2, 3> ProjectionJacobian(const CameraModel& camera, const Eigen::Vector3d& in_base);

/// Optical centre in the base frame [m]: where all rows of the DLT matrix vanish.
Eigen::Vector3d OpticalCentre(const CameraModel& camera);

}  // namespace priamos::head
