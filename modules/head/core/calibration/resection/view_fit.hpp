#pragma once

#include <Eigen/Core>
#include <span>

#include "common/image_size.hpp"
#include "common/outcome.hpp"
#include "head/core/calibration/resection/point_pair.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// A camera with square pixels at a pose: fewer parameters than a DLT matrix, so that few or uncertain
/// points determine it. Camera axes: x right, y down, z forward.
struct PinholeView {
  Eigen::Matrix3d camera_from_object = Eigen::Matrix3d::Identity();
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< the object's origin in the camera
  double focal_px = 1000;
  Eigen::Vector2d centre_px = ImageSize{}.Centre();
  double k1 = 0;  ///< with CameraModel::scale_px = focal_px

  Eigen::Vector3d InCamera(const Eigen::Vector3d& in_object) const {
    return camera_from_object * in_object + offset_m;
  }
  /// The distorted image; the point must lie before the camera.
  Eigen::Vector2d Project(const Eigen::Vector3d& in_object) const;
  CameraModel Model() const;
};

/// What is known of the lens beforehand; a sigma of 0 keeps the view's value.
struct LensPrior {
  double focal_px = 1150;
  double focal_log_sigma = 0.4;
  Eigen::Vector2d centre_px = ImageSize{}.Centre();
  double centre_sigma_px = 0;
  double k1_sigma = 0;
};

/// Gauss-Newton on the reprojection error of distorted image points, starting from `view`, which it
/// improves; errors count as if they had a standard deviation of `sigma_px`, larger ones than that weigh
/// less (Cauchy). Returns the weighted RMS error [px]; a huge number if a point falls behind the camera.
double FitView(PinholeView& view, std::span<const PointPair> pairs, const LensPrior& prior, int steps,
               double sigma_px);

/// Fits a view without a start value: scaled orthography first, perspective after. For points whose
/// perspective is too weak for a DLT matrix. Refuses when no camera comes near the points.
Outcome<PinholeView> FitViewFromPoints(std::span<const PointPair> pairs);

}  // namespace priamos::head
