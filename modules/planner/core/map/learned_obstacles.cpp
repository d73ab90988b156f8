#include "planner/core/map/learned_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// A wall is looked at in such steps, and a shorter piece of it is nothing of its own.
constexpr double kStep_m = 0.1, kLeastPiece_m = 0.4;
/// What is nearer to something of the plan is that: people measure to so much, and sonars add their sigma.
constexpr double kOnPlan_m = 0.15;
constexpr double kMostSigma_m = 0.15;
/// Only the side that was heard is known. The wall is behind it.
constexpr double kThickness_m = 0.04;

Rectangle ShapeOf(const LearnedWall& wall, double low_m, double high_m) {
  const Pose2 centre = wall.map_from_wall() * Pose2{(low_m + high_m) / 2, -kThickness_m / 2, 0};
  return {centre, {(high_m - low_m) / 2, kThickness_m / 2}};
}

/// Whether the wall is at a place of its own there.
bool IsNew(const LearnedWall& wall, double along_m, const ObstacleMap& plan) {
  const double sigma_m = wall.SigmaAt(along_m);
  if (sigma_m > kMostSigma_m) return false;
  const Eigen::Vector2d at = wall.At(along_m);
  return plan.NearestTo({{at.x(), at.y(), 0}, {0, 0}}).distance_m > kOnPlan_m + 2 * sigma_m;
}

}  // namespace

std::vector<NamedObstacle> ObstaclesOf(const LearnedWalls& learned, const ObstacleMap& plan) {
  std::vector<NamedObstacle> obstacles;
  for (const LearnedWall& wall : learned.walls) {
    const int steps = std::max(1, static_cast<int>(std::ceil(wall.length_m / kStep_m)));
    const double step_m = wall.length_m / steps;
    double begun_m = 0;
    bool inside = false;
    for (int i = 0; i <= steps + 1; ++i) {
      const double along_m = -wall.length_m / 2 + i * step_m;
      const bool is_new = i <= steps && IsNew(wall, along_m, plan);
      if (is_new && !inside) begun_m = along_m;
      const double end_m = along_m - step_m;
      if (!is_new && inside && end_m - begun_m >= std::min(kLeastPiece_m, wall.length_m))
        obstacles.push_back({fmt::format("learned wall {}", wall.id), ShapeOf(wall, begun_m, end_m)});
      inside = is_new;
    }
  }
  return obstacles;
}

}  // namespace priamos::planner
