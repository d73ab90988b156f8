#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A straight edge of space, reconstructed from its images (paper, section 5).
struct SpaceEdge {
  Eigen::Vector3d from, to;  ///< base frame [m]: the part that all images show, in the left one's direction
  /// Covariance of (from, to) across the edge [m^2]; 0 along it: an edge does not determine that direction,
  /// and its ends are only where the images end.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double chi2 = 0;  ///< misfit of the images, 2 * (number of images) - 4 degrees of freedom
};

/// An image line, one of several observations of the same edge.
struct LineSighting {
  const CameraView* view = nullptr;
  int line = 0;  ///< in view->lines
};

/// Reconstructs an edge from two or more image lines by least squares; `camera_sigma_px` is the calibration's
/// part of their errors. nullopt if the planes of sight are the same or the edge lies behind a camera, or if
/// no part of it is in all images.
std::optional<SpaceEdge> Reconstruct(std::span<const LineSighting> sightings, double camera_sigma_px);

/// Image of another camera's optical centre, homogeneous: all epipolar lines pass through it.
Eigen::Vector3d Epipole(const CameraModel& in, const CameraModel& of);

/// Angle between a line and the epipolar line through its middle, 0 to pi/2. Near 0 the other camera does not
/// determine the depth of the edge.
double EpipolarAngle(const ViewLine& line, const Eigen::Vector3d& epipole);

/// Distance from the optical centre along the optical axis, if the DLT matrix has any scale [m].
double MetricDepth(const CameraModel& camera, const Eigen::Vector3d& in_base);

}  // namespace priamos::head
