#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/scene/face_cover.hpp"
#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// A level edge of space at a height at which the robot has a body: the border of a table top, a shelf, a
/// desk.
struct LevelBorder {
  Eigen::Vector2d from, to;  ///< its ends in the floor plan, as far as they are seen, base frame [m]
  double height_m = 0;       ///< above the floor
  double sigma_m = 0;        ///< standard deviation of that height
  bool from_ends = false, to_ends = false;  ///< whether it ends there, and not only its picture

  double length_m() const { return (to - from).norm(); }
  Eigen::Vector2d direction() const { return (to - from).normalized(); }
};

/// Which edges of space are such borders.
struct LevelBorderOptions {
  double low_m = 0.45;        ///< lower ones are heard by the sonars
  double high_m = 1.35;       ///< the top of the robot
  double below_eye_m = 0.08;  ///< nearer to the height of the camera none tells its distance
  double slope = 0.03;        ///< tangent of the largest angle to the level, beyond 3 sigmas
  double min_length_m = 0.2;  ///< of a border that is told by stereo alone
  double max_sigma_m = 0.03;  ///< of its height
  double max_distance_m = 5;  ///< from the camera
  double corner_px = 6;       ///< two borders of one corner end so near to each other in the image
  double square_rad = 0.2;    ///< a border that a corner leads to is square to the first one
  double min_cover = 0.7;     ///< share of it that both images show
  EndTolerance ends{.px = 6, .share = 0.05, .cut_px = 40};  ///< it ends there in both
};

/// The level edges among the matched ones; and those that only a corner tells: an edge along the epipolar
/// lines has no depth of its own, but one that begins where a level edge ends has that one's height. All must
/// be seen by the `third` camera as well, which stands above the others: with two alone every tenth pair of
/// pictures had an edge that is none.
std::vector<LevelBorder> FindLevelBorders(const StereoViews& views, const CameraView& third,
                                          std::span<const StereoMatch> matches,
                                          const LevelBorderOptions& options);

}  // namespace priamos::head
