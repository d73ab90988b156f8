#pragma once

#include <Eigen/Core>
#include <vector>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A vertical edge of the scene, reconstructed from one edge in each image.
struct VerticalEdge {
  Eigen::Vector2d at;               ///< position on the floor (x, y), base frame [m]
  Eigen::Matrix2d covariance;       ///< covariance of the position [m^2]
  double z_min_m = 0, z_max_m = 0;  ///< heights of the part that both cameras see
  int left = 0, right = 0;          ///< indices in CameraView::lines
};

/// Which edges of two images may be one vertical edge of space; ranges from the origin of base [m].
struct VerticalStereoOptions {
  double max_lean_rad = 0.03;  ///< angle of the plane of sight to the vertical, beyond its own noise
  double min_range_m = 0.4, max_range_m = 8;
  double min_overlap = 0.4;       ///< common height over the smaller of both heights
  double max_contrast_ratio = 3;  ///< larger over smaller contrast in the two cameras
  double camera_sigma_px = 0.1;   ///< error of the calibration, added to the noise of the edges
};

/// All pairs of a left and a right edge that can be the same vertical edge of space: both planes of sight are
/// upright, the contrast has the same sign and size, and the heights overlap (the epipolar constraint for
/// edges). Several pairs may share an edge; the caller has to choose.
std::vector<VerticalEdge> MatchVerticals(const CameraView& left, const CameraView& right,
                                         const VerticalStereoOptions& options);

}  // namespace priamos::head
