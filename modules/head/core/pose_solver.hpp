#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "head/core/camera_model.hpp"
#include "head/core/landmark.hpp"

namespace priamos::head {

/// A point of the image that lies on an edge of the model.
struct EdgeObservation {
  int edge = 0, camera = 0;
  Eigen::Vector2d at;   ///< undistorted [px]
  double sigma_px = 0;  ///< across the edge
};

struct PoseSolverOptions {
  bool on_floor = true;           ///< 3 degrees of freedom (x, y, yaw), else all 6
  double model_sigma_m = 0.0008;  ///< how well the model's edges are placed, each axis
  double tilt_sigma_m = 0.00025;  ///< how well they are aligned: at the ends, against the middle
  double camera_sigma_px = 0.1;   ///< how well a camera is calibrated: shift, roll and scale of the image
  /// Covariance of the motion of space (x, y, z, roll, pitch, yaw about the origin of base) by which all
  /// cameras together may be calibrated wrongly: HeadModel::base_covariance.
  Eigen::Matrix<double, 6, 6> base_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double outlier_px = 1.0;  ///< an edge seen farther beside the model loses weight
  int max_iterations = 10;
};

struct PoseSolution {
  bool ok = false;
  Eigen::Isometry3d base_from_landmark = Eigen::Isometry3d::Identity();
  /// Of (x, y, z, roll, pitch, yaw) as in PoseJacobian; zero where fixed.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double rms_px = 0;    ///< of the mean distances of the edges from the model, both images
  double worst_px = 0;  ///< the largest of them
  /// What model errors, camera shifts and the rest would have to be, squared and in units of what they are
  /// expected to be, per degree of freedom: about 1 or less for the right edges, large for wrong ones.
  double misfit = 0;
  std::vector<double> edge_misfit;  ///< the part of each model edge in that sum
};

/// Least squares pose from points on edges, in any number of images, starting at `initial`, without any prior
/// for the pose. The errors of the model's edges, those of each camera and the one that all cameras share are
/// estimated with it under their own priors, so the covariance does not shrink with the number of pixels
/// below what model and calibration allow. Needs edges that determine the pose, else ok is false.
PoseSolution SolvePose(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
                       std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
                       const PoseSolverOptions& options);

}  // namespace priamos::head
