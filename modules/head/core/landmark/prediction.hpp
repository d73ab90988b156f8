#pragma once

#include <Eigen/Core>
#include <vector>

#include "head/core/camera/projection.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// A model edge as one camera should see it.
struct PredictedEdge : ProjectedEdge {
  int edge = 0;          ///< index in LandmarkModel::edges
  double search_px = 0;  ///< sigma of the position across the edge that follows from the pose's covariance
};

/// Jacobian of a point `in_base` of the landmark by (x, y, z, roll, pitch, yaw) of base_from_landmark,
/// turning about the landmark's origin with axes parallel to base.
Eigen::Matrix<double, 3, 6> PoseJacobian(const Eigen::Isometry3d& base_from_landmark,
                                         const Eigen::Vector3d& in_base);

/// `pose` moved by a step of (x, y, z, roll, pitch, yaw), as PoseJacobian has them.
Eigen::Isometry3d Moved(Eigen::Isometry3d pose, const Eigen::Matrix<double, 6, 1>& step);

/// The edges of `model` visible at `base_from_landmark` (equations 5 and 6), for the search in the image.
/// `covariance` is that of (x, y, yaw) of base_from_landmark; edges that may be visible under it are kept.
std::vector<PredictedEdge> PredictEdges(const LandmarkModel& model, const Pose2& base_from_landmark,
                                        const Eigen::Matrix3d& covariance, const CameraModel& camera,
                                        const ImageSize& size);

}  // namespace priamos::head
