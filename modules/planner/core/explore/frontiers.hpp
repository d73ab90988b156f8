#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "planner/core/explore/explored_grid.hpp"

namespace priamos::planner {

/// A border between what is free and what is unknown (Yamauchi 1997): free cells beside unknown ones that
/// hang together.
struct Frontier {
  std::vector<Eigen::Vector2i> cells;
  Eigen::Vector2d middle{0, 0};  ///< mean of the cells' places, map frame

  double length_m() const { return ExploredGrid::kStep_m * static_cast<double>(cells.size()); }
};

/// The frontiers of a grid of at least that length, in the order of their first cells.
std::vector<Frontier> FrontiersOf(const ExploredGrid& grid, double least_m);

/// From a border at least so much is looked at.
inline constexpr double kLeastReach_m = 1.5;

/// Visits the unknown cells so near to a cell, as far as nothing closed is in between: a cell may come
/// several times, each time with another share of its area [m2].
void VisitUnknownBehind(const ExploredGrid& grid, const Eigen::Vector2i& cell, double reach_m,
                        const std::function<void(const Eigen::Vector2i& at, double share_m2)>& visit);

}  // namespace priamos::planner
