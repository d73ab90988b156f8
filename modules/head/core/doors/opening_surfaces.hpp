#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/frame_store.hpp"
#include "common/geometry.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// Both pictures of one exposure with their cameras: left, right. Keeps references.
struct StereoPictures {
  std::array<const GreyImage*, 2> images;
  std::array<const CameraModel*, 2> cameras;
};

/// The rectangle between the uprights of a door as it was found: which edges of its frame these are is not
/// known.
struct OpeningShape {
  Pose2 base_from_door;  ///< middle between the uprights; x through the door
  double width_m = 0, height_m = 0;
};

/// How surfaces in an opening are looked for.
struct SurfaceOptions {
  double margin_m = 0.08;       ///< so far from the uprights: the frame
  double reveal_m = 0.22;       ///< sights that meet the sides of the wall within this depth are left out
  double low_m = 0.4;           ///< from this height up
  double before_m = 0.3;        ///< nearest surface before the door's plane
  double behind_m = 4;          ///< farthest behind it
  double step_px = 1.5;         ///< of the disparity between depths that are tried
  double min_similarity = 0.7;  ///< correlation of grey values of a surface
  double min_lead = 0.1;        ///< over every other depth, or nothing tells which it is
  double min_grey = 2.0;        ///< least deviation of grey values in a window
};

/// A piece of surface, door frame: x is how far behind the plane of the uprights.
struct SurfacePoint {
  Eigen::Vector2d at;
  double sigma_x_m = 0;  ///< of the disparity's peak
};

/// Surfaces seen through or in an opening, by the likeness of both pictures at one depth and no other: small
/// windows of the left one, moved to the right one by planes parallel to the door (a plane sweep, Collins
/// 1996). Windows without structure across the line between the cameras tell nothing and are left out.
std::vector<SurfacePoint> SurfacesIn(const OpeningShape& opening, const StereoPictures& pictures,
                                     const SurfaceOptions& options = {});

}  // namespace priamos::head
