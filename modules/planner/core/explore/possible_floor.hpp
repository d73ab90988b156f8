#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/core/explore/explored_grid.hpp"

namespace priamos::planner {

/// What of the unknown a base could come to cover, if nothing stood in it: where its middle gets from where
/// it was, `clearance_m` off all that is closed and not through the ends of walls, and half its width around.
/// The corner of a room and the gap between two pieces of a wall are none of it, nor is what was in sight:
/// the border of what is free runs through it, but nothing new is seen from there.
class PossibleFloor {
 public:
  /// In sight is what lies so near to the trail, `sight_m`, with nothing closed in between.
  PossibleFloor(const ExploredGrid& grid, const std::vector<Eigen::Vector2d>& trail, double clearance_m,
                double sight_m);

  /// Whether it is unknown and may be covered; false outside of the grid.
  bool Has(const Eigen::Vector2i& cell) const {
    return grid_->Holds(cell.x(), cell.y()) && has_[grid_->IndexOf(cell.x(), cell.y())];
  }

  /// How much of it would be in sight from a cell [m2].
  double Behind_m2(const Eigen::Vector2i& cell) const;

  /// Measures the pieces that hang together, for Region_m2().
  void MeasureRegions();
  /// The largest piece of which something would be in sight from a cell [m2]: a room that was never entered
  /// is one, the corner of a room is a small one.
  double Region_m2(const Eigen::Vector2i& cell) const;

 private:
  void TakeOutOfSight(const std::vector<Eigen::Vector2d>& trail, double sight_m);
  void TakeLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  std::vector<Eigen::Vector2i> RegionOf(const Eigen::Vector2i& from);

  const ExploredGrid* grid_;
  double sight_m_;
  std::vector<bool> has_;
  std::vector<double> region_m2_;  ///< of the piece that each cell is in; empty: not measured
};

}  // namespace priamos::planner
