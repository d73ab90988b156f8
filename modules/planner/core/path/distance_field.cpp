#include "planner/core/path/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>

namespace priamos::planner {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
/// So much farther than the base needs in any heading an obstacle may still be a reason to keep off it.
constexpr double kBeyondSurely_m = 1;

/// From a cell to those beside it, in the order of columns and rows.
struct Step {
  int dx, dy;
  double length_m;
};
constexpr double kAcross_m = DistanceField::kStep_m * std::numbers::sqrt2;
constexpr std::array<Step, 8> kSteps{{{-1, -1, kAcross_m},
                                      {-1, 0, DistanceField::kStep_m},
                                      {-1, 1, kAcross_m},
                                      {0, -1, DistanceField::kStep_m},
                                      {0, 1, DistanceField::kStep_m},
                                      {1, -1, kAcross_m},
                                      {1, 0, DistanceField::kStep_m},
                                      {1, 1, kAcross_m}}};

}  // namespace

DistanceField::DistanceField(const SweptFootprint& space, const Eigen::Vector2d& start,
                             const Eigen::Vector2d& goal, double margin_m, double beyond_m,
                             const std::vector<PassageLane>& lanes)
    : goal_(goal) {
  Eigen::AlignedBox2d box = space.obstacles().Bounds();
  box.extend(start).extend(goal);
  const Eigen::Vector2d low = (box.min() - goal).array() - beyond_m,
                        high = (box.max() - goal).array() + beyond_m;
  x_min_ = static_cast<int>(std::floor(low.x() / kStep_m));
  y_min_ = static_cast<int>(std::floor(low.y() / kStep_m));
  nx_ = static_cast<int>(std::ceil(high.x() / kStep_m)) - x_min_ + 1;
  ny_ = static_cast<int>(std::ceil(high.y() / kStep_m)) - y_min_ + 1;
  const Footprint& body = space.footprint();
  surely_m_ = std::hypot(body.length_m, body.width_m) / 2 + margin_m + std::numbers::sqrt2 * kStep_m;
  Measure(space.obstacles(), surely_m_ + kBeyondSurely_m);
  const double closed_m = std::min(body.length_m, body.width_m) / 2 + margin_m;
  for (const PassageLane& lane : lanes) Open(lane, closed_m);
  to_goal_m_.assign(clearance_m_.size(), kInfinite);
  reaches_start_ = MayReach(start, closed_m);
  if (reaches_start_) Spread(closed_m);
}

void DistanceField::Open(const PassageLane& lane, double closed_m) {
  const Eigen::Vector2d from = lane.before.translation(), to = lane.behind.translation();
  const int steps = static_cast<int>(std::ceil((to - from).norm() / (kStep_m / 2)));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2i cell = CellOf(from + (to - from) * (double(i) / std::max(1, steps)));
    if (!Holds(cell.x(), cell.y())) continue;
    float& clearance_m = clearance_m_[IndexOf(cell.x(), cell.y())];
    clearance_m = std::max(clearance_m, static_cast<float>(closed_m));
  }
}

/// Around one obstacle after the other: a building has many, and each is near to few cells.
void DistanceField::Measure(const ObstacleMap& obstacles, double farthest_m) {
  clearance_m_.assign(std::size_t(nx_) * std::size_t(ny_), static_cast<float>(farthest_m));
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Eigen::AlignedBox2d box = obstacles.BoundsOf(i);
    const Eigen::Vector2d low = ((box.min() - goal_).array() - farthest_m) / kStep_m,
                          high = ((box.max() - goal_).array() + farthest_m) / kStep_m;
    const int x_end = std::min(x_min_ + nx_ - 1, static_cast<int>(std::ceil(high.x()))),
              y_end = std::min(y_min_ + ny_ - 1, static_cast<int>(std::ceil(high.y())));
    for (int y = std::max(y_min_, static_cast<int>(std::floor(low.y()))); y <= y_end; ++y)
      for (int x = std::max(x_min_, static_cast<int>(std::floor(low.x()))); x <= x_end; ++x) {
        float& clearance_m = clearance_m_[IndexOf(x, y)];
        clearance_m = std::min(clearance_m, static_cast<float>(obstacles.DistanceTo(i, PlaceOf(x, y))));
      }
  }
}

/// Floods from around the start. A start in a building from which no way leads to a goal outside of it knows
/// that after its rooms; the way from the goal would be looked for on all that is outside.
bool DistanceField::MayReach(const Eigen::Vector2d& start, double closed_m) const {
  std::vector<bool> known(clearance_m_.size(), false);
  std::vector<std::size_t> open;
  const auto add = [&](int x, int y) {
    if (!Holds(x, y) || known[IndexOf(x, y)]) return;
    known[IndexOf(x, y)] = true;
    if (clearance_m_[IndexOf(x, y)] >= closed_m) open.push_back(IndexOf(x, y));
  };
  const Eigen::Vector2i from = CellOf(start);
  const int first = static_cast<int>(std::ceil(kFirst_m / kStep_m));
  for (int x = from.x() - first; x <= from.x() + first; ++x)
    for (int y = from.y() - first; y <= from.y() + first; ++y) add(x, y);
  while (!open.empty() && !known[IndexOf(0, 0)]) {
    const auto [x, y] = CellAt(open.back());
    open.pop_back();
    for (const auto& [dx, dy, length_m] : kSteps) add(x + dx, y + dy);
  }
  return known[IndexOf(0, 0)];
}

/// Dijkstra from the goal; the goal itself counts as open.
void DistanceField::Spread(double closed_m) {
  using Open = std::pair<float, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  to_goal_m_[IndexOf(0, 0)] = 0;
  open.push({0, IndexOf(0, 0)});
  while (!open.empty()) {
    const auto [distance_m, index] = open.top();
    open.pop();
    if (distance_m > to_goal_m_[index]) continue;
    const auto [x, y] = CellAt(index);
    for (const auto& [dx, dy, length_m] : kSteps) {
      if (!Holds(x + dx, y + dy)) continue;
      const std::size_t next = IndexOf(x + dx, y + dy);
      const auto total = static_cast<float>(distance_m + length_m);
      if (clearance_m_[next] < closed_m || total >= to_goal_m_[next]) continue;
      to_goal_m_[next] = total;
      open.push({total, next});
    }
  }
}

}  // namespace priamos::planner
