#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "planner/core/path/passage_lanes.hpp"
#include "planner/core/path/swept_footprint.hpp"

namespace priamos::planner {

/// Cells of 10 cm around start and goal of a route, counted from the goal: how far each is from the nearest
/// obstacle, and how far from the goal around all of them.
class DistanceField {
 public:
  static constexpr double kStep_m = 0.1;
  /// A route begins at a place so near to its start.
  static constexpr double kFirst_m = 1.5;

  /// The cells reach `beyond_m` farther than the obstacles and both ends. A cell counts as closed when the
  /// circle in the footprint would come nearer than `margin_m` to an obstacle there; but those on `lanes` are
  /// open: what is just wide enough for the base need not have the middle of a cell in its own middle.
  DistanceField(const SweptFootprint& space, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                double margin_m, double beyond_m, const std::vector<PassageLane>& lanes = {});

  std::size_t cells() const { return clearance_m_.size(); }
  /// Cells are named by their steps from the goal.
  bool Holds(int x, int y) const {
    return x >= x_min_ && y >= y_min_ && x < x_min_ + nx_ && y < y_min_ + ny_;
  }
  std::size_t IndexOf(int x, int y) const {
    return std::size_t(y - y_min_) * std::size_t(nx_) + std::size_t(x - x_min_);
  }
  std::pair<int, int> CellAt(std::size_t index) const {
    return {x_min_ + int(index % std::size_t(nx_)), y_min_ + int(index / std::size_t(nx_))};
  }
  Eigen::Vector2d PlaceOf(int x, int y) const { return goal_ + kStep_m * Eigen::Vector2d(x, y); }
  /// Steps from the goal of the cell that holds a place.
  Eigen::Vector2i CellOf(const Eigen::Vector2d& in_map) const {
    return ((in_map - goal_) / kStep_m).array().round().cast<int>();
  }

  /// Distance from the cell's middle to the nearest obstacle [m]; one more than a metre beyond what the base
  /// needs in any heading counts as that: farther away it makes no difference to a route.
  double Clearance(int x, int y) const { return clearance_m_[IndexOf(x, y)]; }
  /// Distance to the goal from cell to cell that are not closed [m]; infinite where no way leads.
  double ToGoal(int x, int y) const { return to_goal_m_[IndexOf(x, y)]; }
  /// Whether a way over cells that are not closed may lead from the start to the goal; without one ToGoal is
  /// infinite everywhere.
  bool ReachesStart() const { return reaches_start_; }
  /// Whether the footprint fits in whatever heading, and also on the step to the cell.
  bool SurelyFree(int x, int y) const { return Clearance(x, y) > surely_m_; }

 private:
  void Measure(const ObstacleMap& obstacles, double farthest_m);
  void Open(const PassageLane& lane, double closed_m);
  bool MayReach(const Eigen::Vector2d& start, double closed_m) const;
  void Spread(double closed_m);

  Eigen::Vector2d goal_;
  int x_min_ = 0, y_min_ = 0, nx_ = 0, ny_ = 0;
  double surely_m_ = 0;
  bool reaches_start_ = false;
  std::vector<float> clearance_m_, to_goal_m_;
};

}  // namespace priamos::planner
