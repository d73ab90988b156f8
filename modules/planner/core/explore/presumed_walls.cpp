#include "planner/core/explore/presumed_walls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/geometry.hpp"

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// The walls of a corner stand perpendicular to each other, so well, and those on a line parallel.
constexpr double kAskew_rad = Radians(12), kOffLine_m = 0.2;
/// A wall that is told so much too long still ends in the corner.
constexpr double kTooLong_m = 0.3;
/// A corner that was heard lies so near to where the lines of its walls cross, an edge to the end of its
/// wall.
constexpr double kSameCorner_m = 0.3, kSameEdge_m = 0.4;
/// Where the middle of a base was nothing is so near.
constexpr double kBody_m = 0.4;

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

/// The places of a trail but for its last metres.
std::vector<Vector2d> WithoutLast(std::vector<Vector2d> trail, double most_m) {
  double left_m = most_m;
  while (trail.size() > 1 && left_m > 0) {
    left_m -= (trail.back() - trail[trail.size() - 2]).norm();
    trail.pop_back();
  }
  if (left_m > 0) trail.clear();
  return trail;
}

/// What is known of the ends of walls.
class WallEnds {
 public:
  WallEnds(const LearnedWalls& walls, const std::vector<Vector2d>& trail, const PresumedWallConfig& config)
      : walls_(walls), trail_(trail), past_(WithoutLast(trail, config.told_m)), config_(config) {}

  /// No wall goes on farther.
  double most_m() const { return std::max({config_.corner_m, config_.heard_m, config_.unheard_m}); }
  /// How far a wall goes on at most, towards where the line of another one crosses its own.
  double MostToCorner_m(const LearnedWall& wall, double corner_m) const {
    if (!GoesOn(wall, corner_m)) return config_.corner_m;
    return WasHeard(wall.At(corner_m), kSameCorner_m) ? config_.heard_m : config_.unheard_m;
  }
  /// Whether the base drove past the end of a wall on that side and heard no edge there.
  bool GoesOn(const LearnedWall& wall, double side) const {
    const Vector2d end = wall.At(std::copysign(wall.length_m / 2, side));
    const Pose2 from_map = wall.map_from_wall().Inverse();
    const auto passed = [&](const Vector2d& at) {
      return (at - end).norm() < config_.passed_m && (from_map * at).y() > 0;
    };
    return !WasHeard(end, kSameEdge_m) && std::any_of(past_.begin(), past_.end(), passed);
  }
  /// Whether the base was there, which nothing can be then.
  bool WasPassed(const LearnedWall& piece) const {
    const Vector2d from = piece.from(), to = piece.to();
    return std::any_of(trail_.begin(), trail_.end(),
                       [&](const Vector2d& at) { return DistanceToSegment(from, to, at) < kBody_m; });
  }

 private:
  bool WasHeard(const Vector2d& place, double near_m) const {
    return std::any_of(walls_.points.begin(), walls_.points.end(),
                       [&](const LearnedPoint& point) { return (point.at() - place).norm() < near_m; });
  }

  const LearnedWalls& walls_;
  const std::vector<Vector2d>& trail_;
  std::vector<Vector2d> past_;  ///< of the trail, where an edge that was heard has been told
  const PresumedWallConfig& config_;
};

/// What is missing of a wall to the corner with another one.
std::optional<LearnedWall> ToCorner(const LearnedWall& wall, const LearnedWall& other, const WallEnds& ends) {
  const auto on_wall = CornerOn(wall, other), on_other = CornerOn(other, wall);
  if (!on_wall || !on_other) return std::nullopt;
  const auto meets = [&](const LearnedWall& one, double corner_m) {
    const double missing_m = MissingTo(corner_m, one);
    return missing_m >= -kTooLong_m && missing_m <= ends.most_m() &&
           missing_m <= ends.MostToCorner_m(one, corner_m);
  };
  if (MissingTo(*on_wall, wall) <= 0 || !meets(wall, *on_wall) || !meets(other, *on_other))
    return std::nullopt;
  return Continued(wall, *on_wall);
}

/// What is missing of a wall to the next piece on its line, in its direction.
std::optional<LearnedWall> ToNext(const LearnedWall& wall, const LearnedWall& next, const WallEnds& ends,
                                  double most_m) {
  const Pose2 wall_from_next = wall.map_from_wall().Inverse() * next.map_from_wall();
  const double begin_m = wall_from_next.x - next.length_m / 2, missing_m = MissingTo(begin_m, wall);
  const bool on_line = std::abs(wall_from_next.yaw) < kAskew_rad && std::abs(wall_from_next.y) < kOffLine_m;
  if (!on_line || begin_m <= 0 || missing_m <= 0 || missing_m > most_m) return std::nullopt;
  if (!ends.GoesOn(wall, 1) || !ends.GoesOn(next, -1)) return std::nullopt;
  return Continued(wall, begin_m);
}

}  // namespace

void PresumedWallConfig::Describe(Archive& a) {
  a.Number("corner_m", corner_m, {"m", 0, 2, "walls meet where no more than so much of either is missing"});
  a.Number("passed_m", passed_m, {"m", 0, 5, "so near to the end of a wall an edge would be heard"});
  a.Number("told_m", told_m, {"m", 0, 10, "and would be told after so much more driving"});
  a.Number("heard_m", heard_m,
           {"m", 0, 6, "where none was the wall goes on so far to a corner that was heard"});
  a.Number("unheard_m", unheard_m, {"m", 0, 6, "or so far to another wall"});
}

std::vector<LearnedWall> PresumedWalls(const LearnedWalls& walls, const std::vector<Vector2d>& trail,
                                       const PresumedWallConfig& config) {
  const WallEnds ends(walls, trail, config);
  std::vector<LearnedWall> pieces;
  const auto take = [&](const std::optional<LearnedWall>& piece) {
    if (piece && !ends.WasPassed(*piece)) pieces.push_back(*piece);
  };
  for (const LearnedWall& wall : walls.walls)
    for (const LearnedWall& other : walls.walls) {
      take(ToCorner(wall, other, ends));
      take(ToNext(wall, other, ends, config.unheard_m));
    }
  return pieces;
}

}  // namespace priamos::planner
