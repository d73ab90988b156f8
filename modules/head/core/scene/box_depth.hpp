#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// When level edges behind a front are those of a box's top.
struct DepthOptions {
  double below_eye_m = 0.1;  ///< the top is at least so far below the camera
  double corner_m = 0.04;    ///< such an edge begins at a corner of the front ...
  double square_rad = 0.15;  ///< ... and leads away at a right angle
  double min_depth_m = 0.1, max_depth_m = 2;
  double same_m = 0.04, same_share = 0.1;  ///< both images agree on its length
};

/// How far a box reaches behind its front, from the sides of its top: they are level at `top_m`, a height
/// that is known, so each image tells where they end. The front is `width_m` broad and stands at
/// `base_from_front`, x away from the head. nullopt: no side is seen in both images.
std::optional<double> DepthBehind(const StereoViews& views, const Pose2& base_from_front, double width_m,
                                  double top_m, const DepthOptions& options);

}  // namespace priamos::head
