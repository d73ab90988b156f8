#include "planner/core/explore/presumed_corners.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// The walls of a corner stand perpendicular to each other, so well.
constexpr double kAskew_rad = Radians(12);
/// A wall that is told so much too long still ends in the corner.
constexpr double kTooLong_m = 0.3;
/// A corner that was heard lies so near to where the lines of its walls cross.
constexpr double kSameCorner_m = 0.3;

/// Where the line of another wall crosses a wall's, along it from its middle; nullopt: the room is not before
/// both, or they are not perpendicular.
std::optional<double> CornerOn(const LearnedWall& wall, const LearnedWall& other) {
  const double turned = std::abs(WrapAngle(Radians(wall.yaw_deg - other.yaw_deg)));
  if (std::abs(turned - kPi / 2) > kAskew_rad) return std::nullopt;
  const Pose2 from_map = wall.map_from_wall().Inverse();
  const Vector2d a = from_map * other.from(), b = from_map * other.to();
  if (a.y() + b.y() <= 0) return std::nullopt;
  return a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y());
}

/// How much is missing of a wall to a place on its line; negative: it reaches beyond.
double MissingTo(double at_m, const LearnedWall& wall) {
  return std::abs(at_m) - wall.length_m / 2;
}

LearnedWall Continued(const LearnedWall& wall, double to_m) {
  LearnedWall piece = wall;
  piece.length_m = MissingTo(to_m, wall);
  const Vector2d middle = wall.At(std::copysign(wall.length_m / 2 + piece.length_m / 2, to_m));
  piece.x_m = middle.x();
  piece.y_m = middle.y();
  return piece;
}

}  // namespace

void CornerConfig::Describe(Archive& a) {
  a.Number("most_m", most_m, {"m", 0, 2, "walls meet where no more than so much of either is missing"});
  a.Number("heard_m", heard_m, {"m", 0, 6, "or so much, where the corner itself was heard"});
}

std::vector<LearnedWall> PresumedCorners(const LearnedWalls& walls, const CornerConfig& config) {
  const auto was_heard = [&](const Vector2d& corner) {
    return std::any_of(walls.points.begin(), walls.points.end(), [&](const LearnedPoint& point) {
      return (point.at() - corner).norm() < kSameCorner_m;
    });
  };
  std::vector<LearnedWall> pieces;
  for (const LearnedWall& wall : walls.walls)
    for (const LearnedWall& other : walls.walls) {
      const auto on_wall = CornerOn(wall, other), on_other = CornerOn(other, wall);
      if (!on_wall || !on_other) continue;
      const double most_m = was_heard(wall.At(*on_wall)) ? config.heard_m : config.most_m;
      const auto meets = [&](double missing_m) { return missing_m >= -kTooLong_m && missing_m <= most_m; };
      const double missing_m = MissingTo(*on_wall, wall);
      if (missing_m > 0 && meets(missing_m) && meets(MissingTo(*on_other, other)))
        pieces.push_back(Continued(wall, *on_wall));
    }
  return pieces;
}

}  // namespace priamos::planner
