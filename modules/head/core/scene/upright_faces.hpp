#pragma once

#include <span>
#include <vector>

#include "head/core/scene/upright_edges.hpp"
#include "head/core/stereo/edge_stereo.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// An upright rectangle between two upright edges, which a level edge joins at their upper or lower ends.
struct UprightFace {
  int left = 0, right = 0;  ///< upright edges, as seen from the head
  double bottom_m = 0, top_m = 0;
  int n_levels = 0;         ///< 1: only its upper or its lower edge was seen; 2: both
  double width_m = 0;
};

/// When two upright edges and what is between them are a face.
struct FaceOptions {
  double min_width_m = 0.08, max_width_m = 3;
  double min_width_px = 16;    ///< in either image
  double min_height_m = 0.12;
  double min_cover = 0.6;      ///< share of its level edge that must be seen, in each image
  double corner_m = 0.04;      ///< largest distance of an upright edge's end from the level edge
  double corner_px = 5;        ///< and in the image, beyond that
  double level_m = 0.03;       ///< largest difference of height between the ends of a level edge
  double on_floor_m = 0.15;    ///< an upright edge that ends lower stands on the floor
  double behind_m = 0.06;      ///< what is seen through it is farther behind it than this, beyond 3 sigmas
  double plane_m = 0.04;       ///< faces whose edges lie nearer to one plane, beyond 3 sigmas, are on one plane
};

/// The faces between `uprights`, the larger ones first; one that lies within another, on its plane, is left
/// out. Where edges of the scene (`matches`) are seen through a rectangle, behind it, it is an opening and no
/// face.
std::vector<UprightFace> FindFaces(const StereoViews& views, std::span<const StereoMatch> matches,
                                   std::span<const UprightEdge> uprights, const FaceOptions& options);

}  // namespace priamos::head
