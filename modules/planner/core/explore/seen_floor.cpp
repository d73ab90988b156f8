#include "planner/core/explore/seen_floor.hpp"

#include <algorithm>

#include "planner/core/explore/frontiers.hpp"

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;

constexpr double kSame_m = 0.5;  ///< middles of one frontier before and after a bit more was seen

bool IsFree(const ExploredGrid& grid, int x, int y) {
  int free = 0;
  for (const int dx : {0, 1})
    for (const int dy : {0, 1}) {
      const Cell cell = grid.At(2 * x + dx, 2 * y + dy);
      if (cell == Cell::kClosed) return false;
      free += cell == Cell::kFree ? 1 : 0;
    }
  return free > 0;
}

void AddRow(const ExploredGrid& grid, int row, std::vector<SeenFloor::Run>& runs) {
  const int n = (grid.nx() + 1) / 2;
  for (int x = 0; x < n; ++x) {
    if (!IsFree(grid, x, row)) continue;
    const int first = x;
    while (x < n && IsFree(grid, x, row)) ++x;
    runs.push_back({row, first, x - first});
  }
}

}  // namespace

SeenFloor SeenFloorOf(const ExploredGrid& grid, double least_m, const std::vector<LeftFrontier>& left) {
  SeenFloor seen;
  seen.corner = grid.PlaceOf(0, 0) - 0.5 * ExploredGrid::kStep_m * Eigen::Vector2d::Ones();
  for (int row = 0; 2 * row < grid.ny(); ++row) AddRow(grid, row, seen.free);
  for (const Frontier& frontier : FrontiersOf(grid, least_m)) {
    const bool is_left = std::any_of(left.begin(), left.end(), [&](const LeftFrontier& one) {
      return (one.middle - frontier.middle).norm() < kSame_m;
    });
    seen.edges.push_back({frontier.middle, frontier.length_m(), is_left});
  }
  std::stable_sort(seen.edges.begin(), seen.edges.end(),
                   [](const auto& a, const auto& b) { return a.length_m > b.length_m; });
  return seen;
}

}  // namespace priamos::planner
