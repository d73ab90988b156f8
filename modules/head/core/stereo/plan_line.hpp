#pragma once

#include <Eigen/Core>
#include <optional>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// Whether an image line may show a level edge: not one that is upright.
bool IsLevel(const ViewLine& line);

/// The plane of sight of an image line, cut at a height: for an edge that is level there, the line on which
/// it lies in the floor plan; an upright edge lies on it at any height.
struct PlanLine {
  Eigen::Vector2d normal;
  double offset = 0;  ///< normal.dot(at) + offset = 0

  /// The line at height `z` above the floor [m].
  PlanLine(const ViewLine& line, double z);
};

/// Where two of them meet; nullopt when they are nearly parallel.
std::optional<Eigen::Vector2d> Crossing(const PlanLine& a, const PlanLine& b);

}  // namespace priamos::head
