#pragma once

#include <Eigen/Core>
#include <array>

#include "head/core/doors/line_cover.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A rectangle that stands on the floor: where a door is supposed to be.
struct DoorShape {
  Eigen::Vector2d left, right;  ///< uprights, base frame, as seen from the robot [m]
  double height_m = 0;
};

/// Evidence of one camera for or against a door.
struct DoorEvidence {
  Cover lintel;                       ///< cover of the lintel, from the left to the right upright
  std::array<Cover, 2> uprights;      ///< left, right: from the lintel down to the floor or the border
  std::array<bool, 2> foot_inside{};  ///< the picture shows where they meet the floor
  std::array<double, 2> hangs_m{};    ///< height of their lower ends above the floor or the picture's border
  double sill = 0;                    ///< share of a level edge between their lower ends, if these hang
  double frame_lintel = 0;            ///< share of a second lintel within the first: frame and leaf
  std::array<double, 2> frame_uprights{};  ///< share of second uprights within the first ones
  double log_odds = 0;  ///< sum of all this evidence: a door against whatever else a corridor has
};

/// Evidence in one image for a door at a given place: an edge that is missing counts against it.
DoorEvidence WeighDoor(const CameraView& view, const DoorShape& door);

}  // namespace priamos::head
