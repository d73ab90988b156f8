#pragma once

#include <vector>

#include "common/frame_store.hpp"
#include "head/core/calibration/targets/camera_calibration.hpp"

namespace priamos::head {

/// A flat target of squares; what counts are its inner corners. Its frame: x along a row, y along a column.
struct Chessboard {
  int columns = 9, rows = 6;  ///< number of inner corners
  double spacing_m = 0.025;   ///< side of a square
};

/// The inner corners of one photograph, as observations of points without extent in the board's frame: for
/// CalibrateFromPlanes. Refuses a photograph in which the board is not found as a whole.
Outcome<std::vector<DiscObservation>> FindCorners(const GreyImage& photograph, const Chessboard& board);

}  // namespace priamos::head
