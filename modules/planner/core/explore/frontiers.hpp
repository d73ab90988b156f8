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

/// A frontier in pieces that reach no farther than `most_m`: one that runs around a crossing leads to several
/// places.
std::vector<Frontier> PiecesOf(const Frontier& frontier, const ExploredGrid& grid, double most_m);

/// How much of the unknown that `counts` is within 1.5 m of a cell, as far as nothing closed is in between
/// [m2].
double UnknownBehind_m2(const ExploredGrid& grid, const Eigen::Vector2i& cell,
                        const std::function<bool(const Eigen::Vector2i&)>& counts);

}  // namespace priamos::planner
