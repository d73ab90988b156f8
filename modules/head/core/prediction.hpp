#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "head/core/camera_model.hpp"
#include "head/core/landmark.hpp"

namespace priamos::head {

/// Size of an image [px].
struct ImageSize {
  int width = 768, height = 576;
};

/// A model edge as one camera should see it, undistorted pixels, cut to the image.
struct PredictedEdge {
  int edge = 0;                           ///< index in LandmarkModel::edges
  Eigen::Vector2d p, q;                   ///< ends in the image
  Eigen::Vector3d in_base_p, in_base_q;   ///< the points of space seen there [m]
  double depth_p = 1, depth_q = 1;        ///< their third homogeneous coordinates
  bool p_is_end = true, q_is_end = true;  ///< an end of the model edge, not the border of the image
  double search_px = 0;  ///< 1 sigma of the position across the edge, by the covariance of the pose

  double length_px() const { return (q - p).norm(); }
  Eigen::Vector2d direction() const { return (q - p).normalized(); }
  Eigen::Vector2d normal() const {
    const Eigen::Vector2d d = direction();
    return {-d.y(), d.x()};
  }
  /// The point of space seen at `image` (on or near the predicted line).
  Eigen::Vector3d PointAt(const Eigen::Vector2d& image) const;
};

/// Change of the image point by a change of the point of space: derivative of equations 5 and 6.
Eigen::Matrix<double, 2, 3> ProjectionJacobian(const CameraModel& camera, const Eigen::Vector3d& in_base);

/// Change of a point of space by (x, y, z, roll, pitch, yaw) of base_from_landmark, turning about the
/// landmark's origin with axes parallel to base.
Eigen::Matrix<double, 3, 6> PoseJacobian(const Eigen::Isometry3d& base_from_landmark,
                                         const Eigen::Vector3d& in_base);

/// One edge of space, cut to what lies before the camera and in the image; nullopt if nothing does.
std::optional<PredictedEdge> ProjectEdge(const CameraModel& camera, const ImageSize& size,
                                         const Eigen::Vector3d& from_in_base,
                                         const Eigen::Vector3d& to_in_base);

/// The edges of `model` visible at `base_from_landmark` (equations 5 and 6), for the search in the image.
/// `covariance` is that of (x, y, yaw) of base_from_landmark; edges whose visibility it leaves open are kept.
std::vector<PredictedEdge> PredictEdges(const LandmarkModel& model, const Pose2& base_from_landmark,
                                        const Eigen::Matrix3d& covariance, const CameraModel& camera,
                                        const ImageSize& size);

}  // namespace priamos::head
