#include "common/learned/wall_gaps.hpp"

#include <cmath>
#include <optional>

namespace priamos {
namespace {

constexpr double kNarrowestGap_m = 0.5, kWidestGap_m = 3;
/// Two walls with a gap between them lie on one line.
constexpr double kAcross_m = 0.15, kGapTurned_rad = Radians(8);
/// Lines that cross at less than this make no corner.
constexpr double kLeastCorner_rad = Radians(30);
constexpr double kNearCorner_m = 0.5;

std::optional<WallGap> GapBetween(const LearnedWall& before, const LearnedWall& behind) {
  const Pose2 there = before.map_from_wall().Inverse() * behind.map_from_wall();
  const double from_m = before.length_m / 2, to_m = there.x - behind.length_m / 2;
  if (to_m - from_m < kNarrowestGap_m || to_m - from_m > kWidestGap_m || std::abs(there.yaw) > kGapTurned_rad)
    return std::nullopt;
  const double across_m = there.y + ((from_m + to_m) / 2 - there.x) * std::tan(there.yaw);
  if (std::abs(across_m) > kAcross_m) return std::nullopt;
  const Eigen::Vector2d middle = (before.to() + behind.from()) / 2;
  return WallGap{before.id,
                 behind.id,
                 middle.x(),
                 middle.y(),
                 before.yaw_deg,
                 to_m - from_m,
                 std::hypot(before.sigma_end_m, behind.sigma_end_m)};
}

/// Distance from the end of a wall that is nearer to a point on its line, along it.
double BeyondEnd(const LearnedWall& wall, const Eigen::Vector2d& at) {
  return std::abs(std::abs((wall.map_from_wall().Inverse() * at).x()) - wall.length_m / 2);
}

std::optional<WallCorner> CornerOf(const LearnedWall& a, const LearnedWall& b) {
  const double angle = WrapAngle(Radians(b.yaw_deg - a.yaw_deg));
  if (std::abs(std::sin(angle)) < std::sin(kLeastCorner_rad)) return std::nullopt;
  const Pose2 a_from_b = a.map_from_wall().Inverse() * b.map_from_wall();
  const Eigen::Vector2d cross = a.At(a_from_b.x - a_from_b.y / std::tan(angle));
  if (BeyondEnd(a, cross) > kNearCorner_m || BeyondEnd(b, cross) > kNearCorner_m) return std::nullopt;
  // The left of each wall is where it was heard from.
  return WallCorner{a.id, b.id, cross.x(), cross.y(),
                    a_from_b.y > 0 && (b.map_from_wall().Inverse() * a.map_from_wall()).y > 0};
}

}  // namespace

std::vector<WallGap> GapsOf(const LearnedWalls& walls) {
  std::vector<WallGap> gaps;
  for (const LearnedWall& before : walls.walls) {
    std::optional<WallGap> nearest;
    for (const LearnedWall& behind : walls.walls) {
      const auto gap = GapBetween(before, behind);
      if (gap && (!nearest || gap->width_m < nearest->width_m)) nearest = gap;
    }
    if (nearest) gaps.push_back(*nearest);
  }
  return gaps;
}

std::vector<WallCorner> CornersOf(const LearnedWalls& walls) {
  std::vector<WallCorner> corners;
  for (std::size_t i = 0; i < walls.walls.size(); ++i)
    for (std::size_t k = i + 1; k < walls.walls.size(); ++k)
      if (const auto corner = CornerOf(walls.walls[i], walls.walls[k])) corners.push_back(*corner);
  return corners;
}

}  // namespace priamos
