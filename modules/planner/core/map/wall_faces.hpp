#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/ground_plan.hpp"

namespace priamos::planner {

/// A face of a wall as rooms have it: a line, map frame; on the way from `from` to `to` it is to the right.
struct WallFace {
  Eigen::Vector2d from{0, 0}, to{0, 0};
  double sigma_m = 0;  ///< of the place of either end, across it; 0: that of the plan's walls

  Eigen::Vector2d along() const { return (to - from).normalized(); }
  double length_m() const { return (to - from).norm(); }
  bool operator==(const WallFace&) const = default;
};

/// The most faces that the robot takes.
inline constexpr std::size_t kMostFaces = 3;

/// Both faces of all walls of the plan. Pieces on one line with a doorway between them are one.
std::vector<WallFace> FacesOf(const GroundPlan& plan);

/// The faces that a base has beside it on its way (straight lines over these points), to either side the
/// nearest one: those that go along most of it, kMostFaces at most.
std::vector<WallFace> FacesAlong(const std::vector<WallFace>& faces, const std::vector<Eigen::Vector2d>& way);

/// Distance from a place to the nearest face in a direction of length 1; nullopt: there is none.
std::optional<double> DistanceAhead(const std::vector<WallFace>& faces, const Eigen::Vector2d& from,
                                    const Eigen::Vector2d& direction);

}  // namespace priamos::planner
