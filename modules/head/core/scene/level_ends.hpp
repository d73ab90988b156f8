#pragma once

#include <vector>

#include "head/core/scene/upright_edges.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// How an upright edge is found that stereo has missed.
struct LevelEndOptions {
  double corner_px = 8;      ///< largest distance of a level edge's end from an upright edge
  double min_cover = 0.5;    ///< share of the upright edge that must be seen, in each image
  double eye_level_m = 0.1;  ///< nearer to the height of the camera a level edge tells no distance
  double min_level_px = 16;  ///< of the level edge
};

/// A level edge that begins at the upper end of an upright edge leads to another one: its height is that of
/// the first, so where it ends in one image is a place in space. Where both images show an upright edge below
/// that place it is one of `uprights` from now on, as uncertain as the first one, and more.
void AddUprightsAtLevelEnds(const StereoViews& views, const UprightOptions& same,
                            const LevelEndOptions& options, std::vector<UprightEdge>& uprights);

}  // namespace priamos::head
