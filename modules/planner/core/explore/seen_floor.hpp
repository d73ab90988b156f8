#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/core/explore/exploration.hpp"
#include "planner/core/explore/explored_grid.hpp"

namespace priamos::planner {

/// What an exploration has seen of a floor, for people to look at: coarser than what it decides with.
struct SeenFloor {
  static constexpr double kCell_m = 2 * ExploredGrid::kStep_m;

  /// Cells of a row that are free.
  struct Run {
    int row = 0, first = 0, length = 0;
  };
  /// Where it ends without a wall.
  struct Edge {
    Eigen::Vector2d middle{0, 0};  ///< map frame
    double length_m = 0;
    bool left = false;  ///< it is not driven to
  };

  Eigen::Vector2d corner{0, 0};  ///< of the first cell of the first row, map frame
  std::vector<Run> free;         ///< by rows
  std::vector<Edge> edges;       ///< longest first
};

/// Of four cells of the grid one is made: free when one of them is and none is closed. `left`: frontiers that
/// are not driven to; edges shorter than `least_m` are none.
SeenFloor SeenFloorOf(const ExploredGrid& grid, double least_m, const std::vector<LeftFrontier>& left);

}  // namespace priamos::planner
