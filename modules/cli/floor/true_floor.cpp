#include "cli/floor/true_floor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace priamos::cli {
namespace {

using Eigen::Vector2d;

/// What the base keeps off everything on a route.
constexpr double kMargin_m = 0.10;
/// A greater distance to everything makes no difference.
constexpr double kFar_m = 1;

}  // namespace

std::vector<Rectangle> OutlinesAt(const TrueWorld& world, double low_m, double high_m) {
  std::vector<Rectangle> outlines;
  for (const world::Solid& solid : world.solids)
    if (solid.z_min_m < high_m && solid.z_max_m > low_m)
      outlines.push_back({solid.map_from_solid, solid.size_m / 2});
  return outlines;
}

TrueFloor::TrueFloor(const TrueWorld& world, const Vector2d& start) {
  Eigen::AlignedBox2d around(start);
  for (const Rectangle& outline : OutlinesAt(world, 0, 1))
    for (const Vector2d& corner : outline.Corners()) around.extend(corner);
  origin_ = around.min();
  nx_ = static_cast<int>(std::ceil(around.sizes().x() / kStep_m));
  ny_ = static_cast<int>(std::ceil(around.sizes().y() / kStep_m));
  gap_m_.assign(std::size_t(nx_) * std::size_t(ny_), kFar_m);
  middle_.assign(gap_m_.size(), false);
  seen_ = middle_;
  for (const Rectangle& outline : OutlinesAt(world, world.body.low_m, world.body.high_m)) Measure(outline);
  Flood(start, world.body.size_m.minCoeff() / 2 + kMargin_m);
  Widen(world.body.size_m.minCoeff() / 2);
}

void TrueFloor::SeeFrom(const Vector2d& at) {
  for (const std::size_t cell : CellsSeenFrom(at)) seen_[cell] = true;
}

std::vector<std::size_t> TrueFloor::CellsSeenFrom(const Vector2d& at) const {
  constexpr int kRays = 160;
  std::vector<std::size_t> cells;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2 * kPi * i / kRays;
    for (double m = 0; m <= kSight_m; m += kStep_m / 2) {
      const int index = IndexAt(at + m * Vector2d(std::cos(angle), std::sin(angle)));
      if (index < 0 || gap_m_[std::size_t(index)] <= 0) break;
      if (cells.empty() || cells.back() != std::size_t(index)) cells.push_back(std::size_t(index));
    }
  }
  return cells;
}

int TrueFloor::IndexAt(const Vector2d& in_map) const {
  const Vector2d at = (in_map - origin_) / kStep_m;
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  return x < 0 || y < 0 || x >= nx_ || y >= ny_ ? -1 : y * nx_ + x;
}

double TrueFloor::reachable_m2() const {
  return kStep_m * kStep_m * double(std::count(reachable_.begin(), reachable_.end(), true));
}

double TrueFloor::seen() const {
  std::size_t both = 0, all = 0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    all += reachable_[i];
    both += reachable_[i] && seen_[i];
  }
  return all ? double(both) / double(all) : 0;
}

void TrueFloor::Measure(const Rectangle& outline) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : outline.Corners()) box.extend(corner);
  const Vector2d low = (box.min() - origin_).array() / kStep_m - kFar_m / kStep_m,
                 high = (box.max() - origin_).array() / kStep_m + kFar_m / kStep_m;
  for (int y = std::max(0, int(low.y())); y < std::min(ny_, int(high.y()) + 1); ++y)
    for (int x = std::max(0, int(low.x())); x < std::min(nx_, int(high.x()) + 1); ++x) {
      float& gap_m = gap_m_[CellAt(x, y)];
      gap_m = std::min(gap_m, static_cast<float>(Distance(outline, PlaceOf(x, y))));
    }
}

/// Where the middle of a base gets that keeps `least_m` off everything.
void TrueFloor::Flood(const Vector2d& start, double least_m) {
  std::vector<int> open{IndexAt(start)};
  if (open.front() < 0) return;
  middle_[std::size_t(open.front())] = true;
  while (!open.empty()) {
    const int at = open.back(), x = at % nx_, y = at / nx_;
    open.pop_back();
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int next = (y + dy) * nx_ + x + dx;
      if (x + dx < 0 || y + dy < 0 || x + dx >= nx_ || y + dy >= ny_) continue;
      if (middle_[std::size_t(next)] || gap_m_[std::size_t(next)] < least_m) continue;
      middle_[std::size_t(next)] = true;
      open.push_back(next);
    }
  }
}

/// From where its middle gets to what it covers.
void TrueFloor::Widen(double by_m) {
  reachable_ = middle_;
  const int reach = static_cast<int>(by_m / kStep_m);
  for (int y = 0; y < ny_; ++y)
    for (int x = 0; x < nx_; ++x) {
      if (!middle_[CellAt(x, y)]) continue;
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= nx_ || y + dy >= ny_) continue;
          const std::size_t next = CellAt(x + dx, y + dy);
          if (std::hypot(dx, dy) * kStep_m <= by_m && gap_m_[next] > 0) reachable_[next] = true;
        }
    }
}

}  // namespace priamos::cli
