#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"
#include "common/ground_plan.hpp"

namespace priamos::planner {

/// Which part of a landmark an edge belongs to, seen from the landmark's -x side.
enum class Side { kBoth = 0, kLeft = 1, kRight = 2 };

/// One straight edge of a skeleton, landmark frame [m].
struct LandmarkEdge {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  /// Sector of viewers that see the edge: azimuth of the viewer as seen from the landmark's origin,
  /// counter-clockwise from `visible_from_rad` to `visible_to_rad`, each in (-pi, pi].
  double visible_from_rad = 0, visible_to_rad = 0;
  Side side = Side::kBoth;
};

/// A landmark of the internal map: an edge skeleton with attributes (paper, section 6.1).
struct Landmark {
  int id = 0;
  Pose2 map_from_landmark;
  std::vector<LandmarkEdge> edges;
};

/// The skeleton of a door for a viewer who approaches it: per side the outer arris of the frame, the front
/// arris of the jamb and the arris of the leaf's stop in the depth of the wall, and the same three above.
/// Edges of the far side are left out: the leaf, whose angle nobody knows, hides or moves them.
Landmark MakeDoorLandmark(const DoorPlan& door);

/// Whether a viewer at `in_landmark` is within the edge's sector.
bool IsVisible(const LandmarkEdge& edge, const Eigen::Vector2d& in_landmark);

}  // namespace priamos::planner
