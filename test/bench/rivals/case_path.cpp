#include "test/bench/rivals/case_path.hpp"

#include <cmath>
#include <queue>

#include "planner/core/path/route_planner.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::bench {
namespace {

constexpr double kCell_m = 0.05, kReach_m = 15;
constexpr int kCells = int(2 * kReach_m / kCell_m);
/// A base rolls over what is lower.
constexpr double kFloorClearance_m = 0.02;

/// Cells around a place that a disc may stand on.
class DiscSpace {
 public:
  DiscSpace(const std::vector<world::Solid>& solids, const Eigen::Vector2d& middle, double radius_m)
      : middle_(middle), radius_m_(radius_m) {
    for (const world::Solid& solid : solids)
      if (world::Overlaps(solid, kFloorClearance_m, kDrawnBody.height_m))
        outlines_.push_back(world::OutlineOf(solid));
  }

  bool Joins(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    std::vector<bool> seen(std::size_t(kCells) * kCells);
    std::queue<int> open;
    const int goal = CellOf(to);
    Visit(CellOf(from), seen, open);
    while (!open.empty() && open.front() != goal) {
      const int cell = open.front();
      open.pop();
      const int x = cell % kCells, y = cell / kCells;
      if (x == 0 || y == 0 || x == kCells - 1 || y == kCells - 1) continue;
      for (const int next : {cell - 1, cell + 1, cell - kCells, cell + kCells}) Visit(next, seen, open);
    }
    return !open.empty();
  }

 private:
  int CellOf(const Eigen::Vector2d& at) const {
    const Eigen::Vector2d cell = (at - middle_) / kCell_m + Eigen::Vector2d::Constant(kCells / 2.0);
    return int(cell.y()) * kCells + int(cell.x());
  }
  void Visit(int cell, std::vector<bool>& seen, std::queue<int>& open) const {
    if (seen[std::size_t(cell)]) return;
    seen[std::size_t(cell)] = true;
    const Eigen::Vector2d at = middle_ + kCell_m * (Eigen::Vector2d(cell % kCells, int(cell / kCells)) -
                                                    Eigen::Vector2d::Constant((kCells - 1) / 2.0));
    for (const Rectangle& outline : outlines_)
      if (Distance(outline, at) < radius_m_) return;
    open.push(cell);
  }

  Eigen::Vector2d middle_;
  double radius_m_;
  std::vector<Rectangle> outlines_;
};

/// By hand, as before an opening of which the planner knows the place.
robot::Path Over(std::vector<Pose2> points) {
  robot::Path path{.id = 1, .speed_m_s = kPathSpeed_m_s, .points = std::move(points)};
  path.leeway.assign(path.points.size(), {planner::kLeastLeeway_m, planner::kLeastLeeway_m});
  path.leeway.at(path.leeway.size() / 2) = kNarrowLine;
  return path;
}

}  // namespace

Order OrderBy(const GroundPlan& plan, const Pose2& start, const Pose2& goal,
              const std::vector<Pose2>& instead) {
  const planner::RoutePlanner planner({}, {}, plan);
  if (auto found = planner.FindPath(start, {goal})) {
    const planner::PlannedPath route = planner::FirstPart(std::move(*found));
    return {
        start, {.id = 1, .speed_m_s = kPathSpeed_m_s, .points = route.points, .leeway = route.leeway}, plan};
  }
  std::vector<Pose2> points = instead;
  points.push_back(goal);
  return {start, Over(points), plan};
}

bool CircleFits(const std::vector<world::Solid>& solids, const Pose2& from, const Pose2& to,
                double beside_m) {
  const double radius_m = std::hypot(kDrawnBody.length_m, kDrawnBody.width_m) / 2 + beside_m;
  const Eigen::Vector2d middle = (from.translation() + to.translation()) / 2;
  return DiscSpace(solids, middle, radius_m).Joins(from.translation(), to.translation());
}

}  // namespace priamos::bench
