#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "head/core/camera/camera_model.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/pose_solver.hpp"

namespace priamos::head {

/// Rotation of the right camera relative to the left one, beyond the calibrated pose. A turn about x
/// moves its image up or down (across the epipolar lines), one about y sideways (along them: wrong depths),
/// one about z rolls it.
struct StereoDrift {
  Eigen::Vector3d turn_rad =
      Eigen::Vector3d::Zero();  ///< rotation about the right camera's x right, y down, z forward
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Standard deviations (sigma) of the errors in the estimate of the drift.
struct StereoDriftOptions {
  double model_sigma_m = 0.001;        ///< position error of a landmark's edge, each axis
  double tilt_sigma_m = 0.00025;       ///< alignment error of a landmark's edge
  double edge_sigma_px = 0.07;         ///< error of half an edge in one image, beyond the noise of its points
  double calibration_sigma_px = 0.06;  ///< errors of table and motors of each camera when nothing has moved
  double outlier_px = 0.4;             ///< a half edge with a larger residual loses weight
  int min_edges = 4;                   ///< least number of edges that both images show
};

/// The epipolar residual of tracked edges. Edges have no ends that can be trusted, and a turn about y moves
/// images along the epipolar lines, where two images alone do not determine it. But the edges of a landmark
/// that was found belong to a body of known shape: its pose, the errors of its edges and the cameras' scales
/// are estimated together with the turn, and what both images show alike does not count.
///
/// `observations` as Observations() gives them, camera 0 left, 1 right. nullopt if too few edges are in both
/// images, or if they do not determine the turn.
std::optional<StereoDrift> MeasureDrift(const LandmarkModel& model,
                                        std::span<const EdgeObservation> observations,
                                        const CameraModel& left, const CameraModel& right,
                                        const Eigen::Isometry3d& base_from_landmark,
                                        const StereoDriftOptions& options = {});
/// Focal length c/du of a DLT matrix [px].
double FocalLength(const CameraModel& camera);

}  // namespace priamos::head
