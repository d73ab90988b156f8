#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/archive.hpp"
#include "common/learned/learned_walls.hpp"
#include "common/rectangle.hpp"
#include "planner/core/explore/presumed_walls.hpp"

namespace priamos::planner {

/// What counts as seen from a place where the base was.
struct ExploredGridConfig {
  double near_m = 1.3;        ///< so far around the base centre, as far as no wall is in between
  double wall_reach_m = 3.0;  ///< and up to a wall that was told, which bounds what is free, if it is nearer
  double facing_deg = 40;     ///< and faces the base: so far is the line to it off its perpendicular
  PresumedWallConfig presumed{};  ///< where walls go on although nobody told so

  void Describe(Archive& a);
};

/// Evidence from which the grid is made, map frame.
struct ExploredEvidence {
  std::vector<Eigen::Vector2d> trail;  ///< where the base centre was, in steps of 10 to 30 cm
  LearnedWalls walls;                  ///< as told by now
  std::vector<Rectangle> things;  ///< what else must not be touched: walls of a plan, what stopped the base
  std::vector<Rectangle> seen{};  ///< things that the head saw
  std::vector<Eigen::Vector2d> edges{};  ///< corners and edges where the base has not been
};

/// Cells of 10 cm, each unknown, free or closed (Moravec and Elfes 1985 for the idea of a grid; here it holds
/// no probabilities). It is made anew from all evidence whenever that changes: a wall that is told late, or
/// is told again elsewhere, leaves nothing wrong behind.
class ExploredGrid {
 public:
  static constexpr double kStep_m = 0.1;
  /// What is known of a cell; kDoubtful: the end of a wall, which is told up to 20 cm too long, and what
  /// is missing of two walls to a corner. Nothing is seen through it, but it makes no opening too narrow.
  enum class Cell : std::uint8_t { kUnknown, kFree, kClosed, kDoubtful };

  ExploredGrid(const ExploredGridConfig& config, const ExploredEvidence& evidence);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t cells() const { return cells_.size(); }
  bool Holds(int x, int y) const { return x >= 0 && y >= 0 && x < nx_ && y < ny_; }
  std::size_t IndexOf(int x, int y) const { return std::size_t(y) * std::size_t(nx_) + std::size_t(x); }
  /// Unknown outside of the grid.
  Cell At(int x, int y) const { return Holds(x, y) ? cells_[IndexOf(x, y)] : Cell::kUnknown; }
  Cell At(const Eigen::Vector2d& in_map) const;
  /// Middle of the cell, map frame.
  Eigen::Vector2d PlaceOf(int x, int y) const {
    return origin_ + kStep_m * Eigen::Vector2d(x + 0.5, y + 0.5);
  }
  Eigen::Vector2i CellOf(const Eigen::Vector2d& in_map) const;
  double free_m2() const;
  /// Calls `visit(index, distance_m)` for each cell around a place, as far as `reach_m` along either axis and
  /// inside of the grid; the distance is that of its middle.
  template <class Visit>
  void VisitAround(const Eigen::Vector2d& in_map, double reach_m, const Visit& visit) const {
    const int reach = static_cast<int>(std::ceil(reach_m / kStep_m));
    const Eigen::Vector2i at = CellOf(in_map);
    for (int y = at.y() - reach; y <= at.y() + reach; ++y)
      for (int x = at.x() - reach; x <= at.x() + reach; ++x)
        if (Holds(x, y)) visit(IndexOf(x, y), (PlaceOf(x, y) - in_map).norm());
  }
  /// Corners and edges: in the way, but they hide nothing, and their places are known better than cells.
  const std::vector<Eigen::Vector2d>& edges() const { return edges_; }
  /// Where walls were taken to go on although nobody told so.
  const std::vector<LearnedWall>& presumed() const { return presumed_; }

 private:
  void Close(const ExploredEvidence& evidence);
  void CloseWall(const LearnedWall& wall, bool presumed);
  void CloseThing(const Rectangle& thing);
  void OpenAround(const Eigen::Vector2d& base, double near_m);
  void OpenToWall(const ExploredGridConfig& config, const LearnedWall& wall,
                  const std::vector<Eigen::Vector2d>& trail);
  void OpenLine(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  void OpenWhereItWas(const std::vector<Eigen::Vector2d>& trail);
  Cell* Find(const Eigen::Vector2d& in_map);

  Eigen::Vector2d origin_{0, 0};  ///< corner of the first cell
  int nx_ = 0, ny_ = 0;
  std::vector<Cell> cells_;
  std::vector<LearnedWall> presumed_;
  std::vector<Eigen::Vector2d> edges_;
};

}  // namespace priamos::planner
