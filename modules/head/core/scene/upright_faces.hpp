#pragma once

#include <span>
#include <vector>

#include "head/core/scene/face_cover.hpp"
#include "head/core/scene/scene_edges.hpp"
#include "head/core/scene/upright_edges.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// An upright rectangle between two upright edges, which a level edge joins at their upper ends.
struct UprightFace {
  int left = 0, right = 0;  ///< upright edges, as seen from the head
  double bottom_m = 0, top_m = 0;
  double width_m = 0;
  double quality = 0;  ///< share of its upper, left and right edge that both images show, their mean
};

/// When two upright edges and what is between them are a face.
struct FaceOptions {
  double min_width_m = 0.08, max_width_m = 3;
  double min_height_m = 0.12;
  double min_cover = 0.6;  ///< share of its upper edge that must be seen, in each image
  double corner_m = 0.04;  ///< largest distance of an upright edge's end from the level edge
  double corner_px = 5;    ///< and in the image, beyond that
  double beyond_m = 0.3;   ///< so far below and above a corner its upright edge is looked at:
  double min_below = 0.6, most_beyond = 0.4;  ///< shares that must be seen, and must not
  EndTolerance ends;  ///< the level edge reaches so near to the upright ones, in each image
  double min_quality = 0.6;
  double level_m = 0.02;     ///< largest difference of height between the ends of a level edge
  double on_floor_m = 0.15;  ///< an upright edge that ends lower stands on the floor
  double behind_m = 0.06;    ///< what is seen through it is farther behind it than this, beyond 3 sigmas
  double max_overlap = 0.5;  ///< share of a face, in the left image, where a better one is
  double plane_m = 0.04;     ///< faces whose edges lie nearer to one plane, beyond 3 sigmas, are on one plane
};

/// The faces between `uprights`, the larger and better seen ones first; one that lies within another, on its
/// plane, is left out, and so is one that is seen where another one is. Where `edges` of the scene
/// are seen through a rectangle, behind it, it is an opening and no face.
std::vector<UprightFace> FindFaces(const StereoViews& views, std::span<const SceneEdge> edges,
                                   std::span<const UprightEdge> uprights, const FaceOptions& options);

}  // namespace priamos::head
