#pragma once

#include <vector>

#include "head/core/stereo/grey_relation.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// Which edges of two images may be one edge of space.
struct StereoOptions {
  double min_epipolar_rad = 0.12;  ///< flatter edges are flagged, not triangulated
  double min_depth_m = 0.4, max_depth_m = 12;
  double min_overlap = 0.5;  ///< common extent along the epipolar lines over the shorter extent
  /// Grey values on the side of the edge that agrees better, and larger over smaller contrast: both after
  /// the relation between the cameras.
  double max_grey_difference = 20;
  double max_contrast_ratio = 2;
  double max_turn_rad = 0.7;     ///< largest angle between the planes of sight
  double camera_sigma_px = 0.1;  ///< error of the calibration, added to the noise of the edges
  double max_distance_px = 1.0;  ///< from the edge in the third image to where two epipolar lines cross,
                                 ///< beyond 3 sigma
};

/// Two lines of two views that can be the same edge.
struct StereoPair {
  int first = 0, second = 0;
  double similarity = 0;    ///< 0..1
  double epipolar_rad = 0;  ///< angle between line and epipolar line, the smaller of both images
};

/// All pairs of lines that can be the same edge; a line may be in several pairs. How both cameras' grey
/// values are related is estimated from the lines.
std::vector<StereoPair> FindPairs(const CameraView& first, const CameraView& second,
                                  const StereoOptions& options);

/// How the grey values of two views are related, as far as their lines tell.
GreyRelation RelationOf(const CameraView& first, const CameraView& second, const StereoOptions& options);

/// Similarity of the grey values beside two lines, 0 (too different) to 1.
double GreySimilarity(const CameraView& a, int line_a, const CameraView& b, int line_b,
                      const GreyRelation& relation, const StereoOptions& options);

}  // namespace priamos::head
