#include "planner/core/explore/frontiers.hpp"

#include <cmath>
#include <utility>

#include "common/geometry.hpp"

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;

bool IsFrontier(const ExploredGrid& grid, int x, int y) {
  if (grid.At(x, y) != Cell::kFree) return false;
  return grid.At(x + 1, y) == Cell::kUnknown || grid.At(x - 1, y) == Cell::kUnknown ||
         grid.At(x, y + 1) == Cell::kUnknown || grid.At(x, y - 1) == Cell::kUnknown;
}

/// All that hangs together with a cell, corners included; takes them from `open`.
Frontier Gather(const ExploredGrid& grid, const Eigen::Vector2i& first, std::vector<bool>& open) {
  Frontier frontier;
  std::vector<Eigen::Vector2i> next{first};
  open[grid.IndexOf(first.x(), first.y())] = false;
  while (!next.empty()) {
    const Eigen::Vector2i cell = next.back();
    next.pop_back();
    frontier.cells.push_back(cell);
    frontier.middle += grid.PlaceOf(cell.x(), cell.y());
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const Eigen::Vector2i beside(cell.x() + dx, cell.y() + dy);
        if (!grid.Holds(beside.x(), beside.y()) || !open[grid.IndexOf(beside.x(), beside.y())]) continue;
        open[grid.IndexOf(beside.x(), beside.y())] = false;
        next.push_back(beside);
      }
  }
  frontier.middle /= static_cast<double>(frontier.cells.size());
  return frontier;
}

}  // namespace

std::vector<Frontier> FrontiersOf(const ExploredGrid& grid, double least_m) {
  std::vector<bool> open(grid.cells(), false);
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x) open[grid.IndexOf(x, y)] = IsFrontier(grid, x, y);
  std::vector<Frontier> frontiers;
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x) {
      if (!open[grid.IndexOf(x, y)]) continue;
      Frontier frontier = Gather(grid, {x, y}, open);
      if (frontier.length_m() >= least_m) frontiers.push_back(std::move(frontier));
    }
  return frontiers;
}

void VisitUnknownBehind(const ExploredGrid& grid, const Eigen::Vector2i& cell, double reach_m,
                        const std::function<void(const Eigen::Vector2i&, double)>& visit) {
  constexpr int kRays = 36;
  constexpr double kTurn_rad = 2 * kPi / kRays;
  const Eigen::Vector2d place = grid.PlaceOf(cell.x(), cell.y());
  for (int i = 0; i < kRays; ++i) {
    const Eigen::Vector2d ray(std::cos(kTurn_rad * i), std::sin(kTurn_rad * i));
    for (double at_m = ExploredGrid::kStep_m; at_m <= reach_m; at_m += ExploredGrid::kStep_m) {
      const Eigen::Vector2i at = grid.CellOf(place + at_m * ray);
      const Cell what = grid.At(at.x(), at.y());
      if (what == Cell::kClosed || what == Cell::kDoubtful) break;
      if (what == Cell::kUnknown) visit(at, at_m * kTurn_rad * ExploredGrid::kStep_m);
    }
  }
}

}  // namespace priamos::planner
