#pragma once

#include <vector>

#include "common/frame_store.hpp"

namespace priamos::head {

/// The bounding box of one connected bright region; columns and rows inclusive.
struct BrightRegion {
  int u_min = 0, u_max = 0, v_min = 0, v_max = 0;
  int pixels = 0;  ///< bright pixels in every second row: only those rows are scanned

  int width() const { return u_max - u_min + 1; }
  int height() const { return v_max - v_min + 1; }
};

/// Connected regions that are at least `min_contrast` grey levels brighter than what lies to the left and
/// to the right of them in the same row, whatever the brightness of the image as a whole. Slopes of up to
/// one grey level per pixel count as background. Every second row is read.
std::vector<BrightRegion> FindBrightRegions(const GreyImage& image, int min_contrast);

}  // namespace priamos::head
