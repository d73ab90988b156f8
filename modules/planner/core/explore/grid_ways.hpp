#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/core/explore/explored_grid.hpp"

namespace priamos::planner {

/// How far every free cell is from a base, from cell to cell (Dijkstra), and how far from what is closed.
class GridWays {
 public:
  /// Ways lead over free cells that are at least `clearance_m` from closed ones; but where the base stands
  /// it may begin.
  GridWays(const ExploredGrid& grid, const Eigen::Vector2d& from, double clearance_m);

  /// Length of the way [m]; infinite where none leads.
  double Way_m(const Eigen::Vector2i& cell) const { return way_m_[grid_->IndexOf(cell.x(), cell.y())]; }
  /// Distance to the middle of the nearest closed cell, along the axes and diagonals of the grid, or to the
  /// nearest edge; 3 m at most.
  double Clearance_m(const Eigen::Vector2i& cell) const {
    return clearance_m_[grid_->IndexOf(cell.x(), cell.y())];
  }

  /// Lengths of the ways from a free place to others.
  std::vector<double> WaysFrom(const Eigen::Vector2i& from, const std::vector<Eigen::Vector2i>& places) const;

 private:
  void KeepOff(const Eigen::Vector2d& edge);
  template <class Passable>
  void Spread(std::vector<float>& distance_m, const std::vector<std::size_t>& sources,
              const Passable& passable) const;

  const ExploredGrid* grid_;
  double least_m_;
  std::vector<float> clearance_m_, way_m_;
};

}  // namespace priamos::planner
