#include "planner/core/explore/grid_ways.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;

/// More clearance makes no difference to a base.
constexpr float kClearEnough_m = 3;
/// A base that stands nearer to something than it would drive may leave it over so much.
constexpr double kLeaving_m = 0.7;

}  // namespace

/// Shortest distances from the sources, which are 0.
template <class Passable>
void GridWays::Spread(std::vector<float>& distance_m, const std::vector<std::size_t>& sources,
                      const Passable& passable) const {
  using Open = std::pair<float, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (const std::size_t source : sources) {
    distance_m[source] = 0;
    open.push({0.0F, source});
  }
  while (!open.empty()) {
    const auto [at_m, index] = open.top();
    open.pop();
    if (at_m > distance_m[index]) continue;
    const int x = static_cast<int>(index % std::size_t(grid_->nx())),
              y = static_cast<int>(index / std::size_t(grid_->nx()));
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        if (!grid_->Holds(x + dx, y + dy)) continue;
        const std::size_t next = grid_->IndexOf(x + dx, y + dy);
        const auto total_m = at_m + static_cast<float>(ExploredGrid::kStep_m * std::hypot(dx, dy));
        if (total_m >= distance_m[next] || !passable(x + dx, y + dy, total_m)) continue;
        distance_m[next] = total_m;
        open.push({total_m, next});
      }
  }
}

void GridWays::KeepOff(const Eigen::Vector2d& edge) {
  grid_->VisitAround(edge, kClearEnough_m, [&](std::size_t index, double distance_m) {
    clearance_m_[index] = std::min(clearance_m_[index], static_cast<float>(distance_m));
  });
}

GridWays::GridWays(const ExploredGrid& grid, const Eigen::Vector2d& from, double clearance_m)
    : grid_(&grid),
      least_m_(clearance_m),
      clearance_m_(grid.cells(), kClearEnough_m),
      way_m_(grid.cells(), std::numeric_limits<float>::infinity()) {
  std::vector<std::size_t> closed;
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x)
      if (grid.At(x, y) == Cell::kClosed) closed.push_back(grid.IndexOf(x, y));
  Spread(clearance_m_, closed, [](int, int, float) { return true; });
  for (const Eigen::Vector2d& edge : grid.edges()) KeepOff(edge);
  const Eigen::Vector2i start = grid.CellOf(from);
  if (!grid.Holds(start.x(), start.y())) return;
  Spread(way_m_, {grid.IndexOf(start.x(), start.y())}, [&](int x, int y, float way_m) {
    if (grid.At(x, y) != Cell::kFree) return false;
    return way_m <= kLeaving_m || clearance_m_[grid.IndexOf(x, y)] >= clearance_m;
  });
}

std::vector<double> GridWays::WaysFrom(const Eigen::Vector2i& from,
                                       const std::vector<Eigen::Vector2i>& places) const {
  std::vector<float> way_m(grid_->cells(), std::numeric_limits<float>::infinity());
  Spread(way_m, {grid_->IndexOf(from.x(), from.y())}, [&](int x, int y, float) {
    return grid_->At(x, y) == Cell::kFree && clearance_m_[grid_->IndexOf(x, y)] >= least_m_;
  });
  std::vector<double> ways;
  ways.reserve(places.size());
  for (const Eigen::Vector2i& place : places) ways.push_back(way_m[grid_->IndexOf(place.x(), place.y())]);
  return ways;
}

}  // namespace priamos::planner
