#include "common/learned/edge_walls.hpp"

#include <algorithm>
#include <cmath>

namespace priamos {
namespace {

/// An arc of an edge is never told longer, and lies so near to it.
constexpr double kMost_m = 2.2, kNear_m = 0.5;
/// Walls of a building are turned against each other by quarter turns, and known so well.
constexpr double kAskew_rad = Radians(12);

bool AreAskew(const LearnedWall& a, const LearnedWall& b) {
  const double turned = Radians(a.yaw_deg - b.yaw_deg);
  return std::abs(std::remainder(turned, kPi / 2)) > kAskew_rad;
}

/// Whether the ends of `a` lie on different sides of the line of `b`.
bool Straddles(const LearnedWall& a, const LearnedWall& b) {
  const Pose2 from_map = b.map_from_wall().Inverse();
  return ((from_map * a.from()).y() < 0) != ((from_map * a.to()).y() < 0);
}

bool IsEdgeOf(const LearnedWall& piece, const LearnedWall& wall) {
  if (wall.length_m <= piece.length_m || !AreAskew(piece, wall)) return false;
  if (Straddles(piece, wall) && Straddles(wall, piece)) return true;
  const double from_m = DistanceToSegment(piece.from(), piece.to(), wall.from()),
               to_m = DistanceToSegment(piece.from(), piece.to(), wall.to());
  return std::min(from_m, to_m) < kNear_m;
}

}  // namespace

LearnedWalls WithoutEdges(const LearnedWalls& walls) {
  LearnedWalls left = walls;
  std::erase_if(left.walls, [&](const LearnedWall& piece) {
    return piece.length_m < kMost_m &&
           std::any_of(walls.walls.begin(), walls.walls.end(),
                       [&](const LearnedWall& wall) { return IsEdgeOf(piece, wall); });
  });
  return left;
}

}  // namespace priamos
