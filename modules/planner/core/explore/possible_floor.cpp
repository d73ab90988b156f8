#include "planner/core/explore/possible_floor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "common/geometry.hpp"
#include "planner/core/explore/frontiers.hpp"

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;
using Eigen::Vector2d;
using Eigen::Vector2i;

/// What the clearance of a base's middle has over half its width.
constexpr double kMargin_m = 0.05;
/// From a cell to those that share a side with it.
constexpr std::array<std::pair<int, int>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
/// A piece whose size is not known yet.
constexpr double kNotMeasured = -1;
/// Lines of sight end so far apart, and begin at places so far apart.
constexpr double kSightRim_m = 0.08, kLooksApart_m = 0.3;

/// Cells whose middles lie within a circle around that of a cell.
std::vector<Vector2i> DiscOf(double radius_m) {
  const double cells = radius_m / ExploredGrid::kStep_m;
  const int reach = static_cast<int>(cells);
  std::vector<Vector2i> disc;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (std::hypot(dx, dy) <= cells) disc.emplace_back(dx, dy);
  return disc;
}

/// Sets all that is so near to one of the cells.
std::vector<bool> Widened(const ExploredGrid& grid, const std::vector<Vector2i>& cells, double by_m) {
  std::vector<bool> wide(grid.cells(), false);
  const std::vector<Vector2i> disc = DiscOf(by_m);
  for (const Vector2i& cell : cells)
    for (const Vector2i& off : disc) {
      const Vector2i at = cell + off;
      if (grid.Holds(at.x(), at.y())) wide[grid.IndexOf(at.x(), at.y())] = true;
    }
  return wide;
}

std::vector<Vector2i> ClosedCells(const ExploredGrid& grid) {
  std::vector<Vector2i> closed;
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x)
      if (grid.At(x, y) == Cell::kClosed) closed.emplace_back(x, y);
  return closed;
}

/// Where the middle of the base gets from where it was.
std::vector<Vector2i> MiddlesFrom(const ExploredGrid& grid, const std::vector<Vector2d>& trail,
                                  double clearance_m) {
  std::vector<bool> barred = Widened(grid, ClosedCells(grid), clearance_m);
  for (const Vector2d& edge : grid.edges())
    grid.VisitAround(edge, clearance_m, [&](std::size_t index, double distance_m) {
      if (distance_m < clearance_m) barred[index] = true;
    });
  std::vector<Vector2i> middles;
  for (const Vector2d& place : trail) {
    const Vector2i at = grid.CellOf(place);
    if (grid.Holds(at.x(), at.y())) middles.push_back(at);
  }
  for (std::size_t i = 0; i < middles.size(); ++i)
    for (const auto& [dx, dy] : kSides) {
      const Vector2i at = middles[i] + Vector2i(dx, dy);
      if (!grid.Holds(at.x(), at.y()) || grid.At(at.x(), at.y()) == Cell::kDoubtful) continue;
      if (barred[grid.IndexOf(at.x(), at.y())]) continue;
      barred[grid.IndexOf(at.x(), at.y())] = true;
      middles.push_back(at);
    }
  return middles;
}

}  // namespace

PossibleFloor::PossibleFloor(const ExploredGrid& grid, const std::vector<Vector2d>& trail, double clearance_m,
                             double sight_m)
    : grid_(&grid),
      sight_m_(sight_m),
      has_(Widened(grid, MiddlesFrom(grid, trail, clearance_m), clearance_m - kMargin_m)) {
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x)
      if (grid.At(x, y) != Cell::kUnknown) has_[grid.IndexOf(x, y)] = false;
  TakeOutOfSight(trail, sight_m);
}

/// Takes what is in sight of the trail.
void PossibleFloor::TakeOutOfSight(const std::vector<Vector2d>& trail, double sight_m) {
  const int rays = static_cast<int>(std::ceil(2 * kPi * sight_m / kSightRim_m));
  std::optional<Vector2d> last;  // the newest counts always
  for (auto at = trail.rbegin(); at != trail.rend(); ++at) {
    if (last && (*at - *last).norm() < kLooksApart_m) continue;
    last = *at;
    for (int i = 0; i < rays; ++i) {
      const double angle = 2 * kPi * i / rays;
      TakeLine(*at, *at + sight_m * Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
}

void PossibleFloor::TakeLine(const Vector2d& from, const Vector2d& to) {
  const int steps = static_cast<int>(std::ceil((to - from).norm() / (ExploredGrid::kStep_m / 2)));
  for (int i = 0; i <= steps; ++i) {
    const Vector2i at = grid_->CellOf(from + (to - from) * (double(i) / std::max(1, steps)));
    const Cell what = grid_->At(at.x(), at.y());
    if (what == Cell::kClosed || what == Cell::kDoubtful || !grid_->Holds(at.x(), at.y())) return;
    has_[grid_->IndexOf(at.x(), at.y())] = false;
  }
}

/// They hang together by the sides of cells.
void PossibleFloor::MeasureRegions() {
  region_m2_.assign(has_.size(), kNotMeasured);
  for (int y = 0; y < grid_->ny(); ++y)
    for (int x = 0; x < grid_->nx(); ++x) {
      if (!Has({x, y}) || region_m2_[grid_->IndexOf(x, y)] != kNotMeasured) continue;
      const std::vector<Vector2i> region = RegionOf({x, y});
      const double m2 = ExploredGrid::kStep_m * ExploredGrid::kStep_m * static_cast<double>(region.size());
      for (const Vector2i& at : region) region_m2_[grid_->IndexOf(at.x(), at.y())] = m2;
    }
}

std::vector<Vector2i> PossibleFloor::RegionOf(const Vector2i& from) {
  std::vector<Vector2i> region;
  const auto take = [&](const Vector2i& at) {
    if (!Has(at) || region_m2_[grid_->IndexOf(at.x(), at.y())] != kNotMeasured) return;
    region_m2_[grid_->IndexOf(at.x(), at.y())] = 0;
    region.push_back(at);
  };
  take(from);
  for (std::size_t i = 0; i < region.size(); ++i)
    for (const auto& [dx, dy] : kSides) take(region[i] + Vector2i(dx, dy));
  return region;
}

double PossibleFloor::Behind_m2(const Vector2i& cell) const {
  double behind_m2 = 0;
  VisitUnknownBehind(*grid_, cell, std::max(kLeastReach_m, sight_m_),
                     [&](const Vector2i& at, double share_m2) { behind_m2 += Has(at) ? share_m2 : 0; });
  return behind_m2;
}

double PossibleFloor::Region_m2(const Vector2i& cell) const {
  double region_m2 = 0;
  VisitUnknownBehind(*grid_, cell, std::max(kLeastReach_m, sight_m_), [&](const Vector2i& at, double) {
    if (Has(at)) region_m2 = std::max(region_m2, region_m2_[grid_->IndexOf(at.x(), at.y())]);
  });
  return region_m2;
}

}  // namespace priamos::planner
