#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::planner {

/// Which part of a landmark an edge belongs to, seen from the landmark's -x side. A movable part (a door's
/// leaf) may stand elsewhere than in the map: finding it there is evidence, missing it is none.
enum class Side { kBoth = 0, kLeft = 1, kRight = 2, kMovable = 3 };

/// One straight edge of a skeleton, landmark frame [m].
struct LandmarkEdge {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  /// Sector of viewers that see the edge: azimuth of the viewer as seen from the landmark's origin,
  /// counter-clockwise from `visible_from_rad` to `visible_to_rad`, each in (-pi, pi].
  double visible_from_rad = 0, visible_to_rad = 0;
  Side side = Side::kBoth;
  /// Logarithm of the brightness right of the edge over that left of it, as the viewer sees it from `from` to
  /// `to`; nullopt: not known.
  std::optional<double> grey_ratio{};
};

/// A landmark of the internal map: an edge skeleton with attributes (paper, section 6.1).
struct Landmark {
  int id = 0;
  Pose2 map_from_landmark;
  std::vector<LandmarkEdge> edges;
};

/// Largest number of edges in a LANDMARK_MODEL.
inline constexpr int kMaxLandmarkEdges = 20;

/// Whether a viewer at `in_landmark` is within the edge's sector.
bool IsVisible(const LandmarkEdge& edge, const Eigen::Vector2d& in_landmark);

}  // namespace priamos::planner
