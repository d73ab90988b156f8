#include "planner/core/map/learned_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/core/map/doorways.hpp"

namespace priamos::planner {
namespace {

/// A wall is looked at in such steps, and a shorter piece of it is nothing of its own.
constexpr double kStep_m = 0.1, kLeastPiece_m = 0.4, kRounding_m = 1e-6;
/// What is nearer to something of the plan is that: people measure to so much, and sonars add their sigma.
constexpr double kOnPlan_m = 0.15;
constexpr double kMostSigma_m = 0.15;
/// Only the side that was heard is known. The wall is behind it.
constexpr double kThickness_m = 0.04;
/// One look may have put together edges that do not belong together.
constexpr int kLeastLooks = 2;
/// What begins higher is driven under, what ends lower is driven over.
constexpr double kHighest_m = 1.6, kLowest_m = 0.03;
/// The head sees things from up to 6 m: what is told farther from the plan is none of this building, and
/// would make routes be looked for all the way there.
constexpr double kBesidePlan_m = 10;

/// A part of a straight front, along it from its middle.
struct Piece {
  double low_m, high_m;
};

/// The parts of a front of that length that are new, as `is_new` says of places along it.
template <class IsNew>
std::vector<Piece> NewPieces(double length_m, IsNew is_new) {
  std::vector<Piece> pieces;
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kStep_m)));
  const double step_m = length_m / steps;
  double begun_m = 0;
  bool inside = false;
  for (int i = 0; i <= steps + 1; ++i) {
    const double along_m = -length_m / 2 + i * step_m;
    const bool is_new_here = i <= steps && is_new(along_m);
    if (is_new_here && !inside) begun_m = along_m;
    const double end_m = along_m - step_m;
    if (!is_new_here && inside && end_m - begun_m >= std::min(kLeastPiece_m, length_m) - kRounding_m)
      pieces.push_back({begun_m, end_m});
    inside = is_new_here;
  }
  return pieces;
}

/// Whether a place that is known so well is one of its own.
bool IsOffPlan(const Eigen::Vector2d& at, double sigma_m, const ObstacleMap& plan) {
  if (sigma_m > kMostSigma_m) return false;
  return plan.NearestTo({{at.x(), at.y(), 0}, {0, 0}}).distance_m > kOnPlan_m + 2 * sigma_m;
}

Rectangle ShapeOf(const LearnedWall& wall, const Piece& piece) {
  const Pose2 centre = wall.map_from_wall() * Pose2{(piece.low_m + piece.high_m) / 2, -kThickness_m / 2, 0};
  return {centre, {(piece.high_m - piece.low_m) / 2, kThickness_m / 2}};
}

bool IsKnownWell(const LearnedObject& object) {
  const bool in_height = object.bottom_m <= kHighest_m && object.top_m >= kLowest_m;
  return object.kind != "edge" && object.looks >= kLeastLooks && in_height &&
         object.sigma_along_m <= kMostSigma_m && object.sigma_across_m <= kMostSigma_m;
}

/// Most of a front that lies on something of the plan is that.
bool IsOnPlan(const LearnedObject& object, const ObstacleMap& plan) {
  double new_m = 0;
  for (const Piece& piece : NewPieces(object.width_m, [&](double along_m) {
         return IsOffPlan(object.map_from_front() * Eigen::Vector2d(0, along_m), object.sigma_across_m, plan);
       }))
    new_m += piece.high_m - piece.low_m;
  return new_m < object.width_m / 2;
}

/// Whether it stands in the building or just outside; anywhere, where nothing is on the plan.
bool IsNearPlan(const LearnedObject& object, const Eigen::AlignedBox2d& plan) {
  return plan.isEmpty() || plan.exteriorDistance(Eigen::Vector2d(object.x_m, object.y_m)) < kBesidePlan_m;
}

/// Its footprint, larger by one sigma of its place.
Rectangle ShapeOf(const LearnedObject& object) {
  Rectangle shape = object.Footprint();
  shape.half_m += Eigen::Vector2d(object.sigma_across_m, object.sigma_along_m);
  return shape;
}

}  // namespace

std::vector<NamedObstacle> ObstaclesOf(const LearnedWalls& learned, const ObstacleMap& plan,
                                       const std::vector<DoorPlan>& doors) {
  std::vector<NamedObstacle> obstacles;
  for (const LearnedWall& wall : learned.walls)
    for (const Piece& piece : NewPieces(wall.length_m, [&](double along_m) {
           return IsOffPlan(wall.At(along_m), wall.SigmaAt(along_m), plan);
         }))
      obstacles.push_back({fmt::format("learned wall {}", wall.id), ShapeOf(wall, piece)});
  const Doorways doorways(doors, learned.doors);
  const Eigen::AlignedBox2d bounds = plan.Bounds();
  for (const LearnedObject& object : learned.objects)
    if (IsKnownWell(object) && IsNearPlan(object, bounds) && !IsOnPlan(object, plan) && !doorways.Has(object))
      obstacles.push_back(
          {fmt::format("{}, {}, seen by the head", NameOf(object), SizeOf(object)), ShapeOf(object)});
  return obstacles;
}

}  // namespace priamos::planner
