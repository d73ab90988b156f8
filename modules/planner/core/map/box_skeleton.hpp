#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "planner/core/map/landmark.hpp"

namespace priamos::planner {

/// An upright box that is part of a landmark, or hides parts of it.
struct LandmarkBox {
  Pose2 landmark_from_box;  ///< centre of its base
  Eigen::Vector2d size_m{0, 0};
  double z_min_m = 0, z_max_m = 0;
  bool has_edges = true;  ///< false: it only hides others
  Side side = Side::kBoth;
};

/// Viewpoints of a landmark: at one height, at some distances from the landmark's origin, within a sector of
/// azimuths from `from_rad` counter-clockwise to `to_rad`.
struct Viewers {
  double from_rad = -kPi, to_rad = kPi;
  double eye_m = 1.25;
  std::vector<double> distances_m{1.6, 2.5, 4.0};
  double min_visible = 0.7;             ///< share of an edge that must be seen from all these distances
  double min_sector_rad = Radians(12);  ///< edges seen from less are left out
};

/// The edges of the boxes that are visible, each with the largest sector of azimuths from which it is seen
/// past all boxes and from every distance. Edges that stand on the floor (below 5 cm) are left out: skirting
/// and shadows are there.
std::vector<LandmarkEdge> SkeletonOf(std::span<const LandmarkBox> boxes, const Viewers& viewers = {});

}  // namespace priamos::planner
