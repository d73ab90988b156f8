#pragma once

#include <Eigen/Core>
#include <array>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A rectangle that stands on the floor: where a door is supposed to be.
struct DoorShape {
  Eigen::Vector2d left, right;  ///< uprights, base frame, as seen from the robot [m]
  double height_m = 0;
};

/// How far image lines cover a segment of the image that is expected, all of one contrast sign.
struct Cover {
  double share = 0;     ///< covered share of the segment
  double first_px = 0;  ///< where the cover begins, from the segment's beginning; negative: before it
  double last_px = 0;   ///< where the cover ends, from the segment's end; positive: beyond it
  int line = -1;        ///< in CameraView::lines: the one that covers most of it
};

/// Evidence of one camera for or against a door.
struct DoorEvidence {
  Cover lintel;                   ///< from the left to the right upright
  std::array<Cover, 2> uprights;  ///< left, right: from the lintel down to the floor or out of the picture
  std::array<bool, 2> foot_inside{};  ///< the picture shows where they meet the floor
  std::array<double, 2> hangs_m{};    ///< their lower ends above the floor, or above the picture's border
  double sill = 0;                    ///< share of a level edge between their lower ends, if these hang
  double frame_lintel = 0;            ///< share of a second lintel within the first: frame and leaf
  std::array<double, 2> frame_uprights{};  ///< share of second uprights within the first ones
  double log_odds = 0;  ///< sum of all this evidence: a door against whatever else a corridor has
};

/// Weighs the edges of one image, whichever they are: an edge that is missing counts against the door.
DoorEvidence WeighDoor(const CameraView& view, const DoorShape& door);

}  // namespace priamos::head
