#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "head/core/camera/camera_model.hpp"
#include "head/core/landmark/edge_residual.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/model_errors.hpp"

namespace priamos::head {

/// The unknowns of the pose solver, and the standard deviations (sigma) of its measurements and models.
struct PoseSolverOptions {
  bool on_floor = true;           ///< 3 degrees of freedom (x, y, yaw), else all 6
  double edge_sigma_px = 0.01;    ///< systematic error of an edge at either end: light, lens, neighbours
  double model_sigma_m = 0.0008;  ///< position error of a model edge, each axis
  double breadth_sigma_m = 0;     ///< error of the landmark's breadth: its left and its right side are apart
  double height_sigma_m = 0;      ///< error of its height: all that is level is higher or lower together
  double depth_sigma_m = 0;       ///< error of the depth of all its edges that lie in one plane square to x
  double tilt_sigma_m = 0.00025;  ///< alignment error of a model edge: at its ends, against its middle
  double movable_sigma_m = 0.01;  ///< position error of a movable part's edge, each axis
  double camera_sigma_px = 0.05;  ///< calibration error of a camera: shift, roll and scale of the image
  /// Covariance of the calibration error that all cameras share, as a motion of space (x, y, z, roll, pitch,
  /// yaw about the origin of base): HeadModel::base_covariance.
  Eigen::Matrix<double, 6, 6> base_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// What is known of the model's edges from earlier looks, whose mean the model has already; null: nothing,
  /// they have the sigmas above. Not owned.
  const ModelErrors* known = nullptr;
  int max_iterations = 10;
  bool find_suspect = true;  ///< compute PoseSolution::suspect, which takes as long as all the rest
  bool learn = false;        ///< compute PoseSolution::errors

  ModelVariance VarianceOfModel() const {
    return {model_sigma_m * model_sigma_m, movable_sigma_m * movable_sigma_m,
            breadth_sigma_m * breadth_sigma_m, height_sigma_m * height_sigma_m,
            depth_sigma_m * depth_sigma_m};
  }
};

/// The worst outlier: the edge, in one image or in all, without which the others fit best.
struct EdgeSuspect {
  int edge = -1, camera = -1;  ///< camera -1: in all of them
  double misfit = 0;           ///< its part of chi squared, per degree of freedom: about 1 for an inlier
};

/// The landmark's pose in the base frame [m, rad] and how well it is known; valid when `ok`.
struct PoseSolution {
  bool ok = false;
  Eigen::Isometry3d base_from_landmark = Eigen::Isometry3d::Identity();
  /// Covariance of (x, y, z, roll, pitch, yaw) as in PoseJacobian [m, rad]; 0 where fixed.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// Share of the covariance that comes from the noise of edges, as a mean over all directions, 0..1. The
  /// rest comes from the model and the calibration and is the same in other looks.
  double own_share = 0;
  double rms_px = 0;  ///< RMS of the edges' distances from the model with edge_shifts, all images
  double chi_squared = 0;
  int n_redundant = 0;  ///< measurements beyond the unknowns: what chi squared is expected to be
  /// Chi squared per degree of freedom under all errors that are expected: about 1 for the right edges, large
  /// for wrong ones.
  double misfit = 0;
  EdgeSuspect suspect;
  /// Errors of the model's edges, as far as the images show them.
  EdgeShifts edge_shifts;
  Breadth
      breadth;  ///< part of edge_shifts; its sigma falls from breadth_sigma_m as far as both sides are seen
  ModelErrors errors;  ///< what is known of the model's edges now; empty if nobody asked to learn it
};

/// Least squares pose from points on edges, in any number of images, starting at `initial`, without any prior
/// for the pose. The points of an edge in an image give two measurements (see ObservedLine). Errors of
/// the model's edges, those of each camera and the one that all cameras share correlate the measurements
/// (generalised least squares), so the covariance does not shrink with the number of pixels below what model
/// and calibration allow. Needs edges that determine the pose, else ok is false.
PoseSolution SolvePose(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
                       std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
                       const PoseSolverOptions& options);

}  // namespace priamos::head
