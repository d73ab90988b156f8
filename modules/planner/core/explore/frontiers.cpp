#include "planner/core/explore/frontiers.hpp"

#include <utility>

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

}  // namespace priamos::planner
