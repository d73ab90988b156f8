#pragma once

#include <Eigen/Core>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A segment of an image where an edge is expected [undistorted px].
struct ExpectedLine {
  Eigen::Vector2d p, direction, normal;
  double length_px = 0;

  ExpectedLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
      : p(from), length_px((to - from).norm()) {
    direction = (to - from) / length_px;
    normal = {-direction.y(), direction.x()};
  }
};

/// The part of an expected image segment that image lines cover.
struct Cover {
  double share = 0;     ///< covered share of the segment
  double first_px = 0;  ///< where the cover begins, from the segment's beginning; negative: before it
  double last_px = 0;   ///< where the cover ends, from the segment's end; positive: beyond it
  int line = -1;        ///< index in CameraView::lines of the one that covers most of it; -1: none
};

/// The cover of `e` by image lines of the contrast sign that covers more; lines may lie `beside_px` beside
/// it.
Cover CoverOf(const CameraView& view, const ExpectedLine& e, double beside_px = 2.0);

/// The same for an edge before things of any brightness: its contrast may change along it.
Cover CoverOfAnyContrast(const CameraView& view, const ExpectedLine& e, double beside_px = 2.0);

}  // namespace priamos::head
