#include "planner/core/explore/passages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// What is left of a wall and shorter than this is nothing of its own.
constexpr double kLeastPiece_m = 0.2;
/// What is surely there of a wall ends so much before its ends at most, and is at least so long.
constexpr double kMostCut_m = 0.2, kLeastSure_m = 0.5;

/// From, to: along a wall, from its middle.
using Span = std::pair<double, double>;

/// Where the trail crosses the line of a wall, in the order of the places along it.
std::vector<double> CrossingsOf(const LearnedWall& wall, const std::vector<Vector2d>& trail) {
  const Pose2 wall_from_map = wall.map_from_wall().Inverse();
  std::vector<double> crossings;
  for (std::size_t i = 1; i < trail.size(); ++i) {
    const Vector2d a = wall_from_map * trail[i - 1], b = wall_from_map * trail[i];
    if ((a.y() < 0) == (b.y() < 0)) continue;
    crossings.push_back(a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y()));
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

std::vector<Span> SpansLeft(double length_m, const std::vector<double>& crossings, double half_width_m) {
  std::vector<Span> left;
  double begin_m = -length_m / 2;
  for (const double at_m : crossings) {
    const double end_m = std::min(at_m - half_width_m, length_m / 2);
    if (end_m - begin_m >= kLeastPiece_m) left.push_back({begin_m, end_m});
    begin_m = std::max(begin_m, at_m + half_width_m);
  }
  if (length_m / 2 - begin_m >= kLeastPiece_m) left.push_back({begin_m, length_m / 2});
  return left;
}

/// The covariance is that of the whole wall's line at the middle of the piece.
LearnedWall PieceOf(const LearnedWall& wall, const Span& span) {
  LearnedWall piece = wall;
  const double middle_m = (span.first + span.second) / 2;
  const Vector2d at = wall.At(middle_m);
  piece.x_m = at.x();
  piece.y_m = at.y();
  piece.length_m = span.second - span.first;
  Eigen::Matrix2d shift = Eigen::Matrix2d::Identity();
  shift(0, 1) = middle_m;
  piece.SetCovariance(shift * wall.covariance() * shift.transpose());
  return piece;
}

}  // namespace

LearnedWalls WithoutPassages(const LearnedWalls& walls, const std::vector<Vector2d>& trail,
                             double half_width_m) {
  LearnedWalls left = walls;
  left.walls.clear();
  for (const LearnedWall& wall : walls.walls) {
    const std::vector<double> crossings = CrossingsOf(wall, trail);
    const bool whole = std::none_of(crossings.begin(), crossings.end(), [&](double at_m) {
      return std::abs(at_m) < wall.length_m / 2 + half_width_m;
    });
    if (whole) {
      left.walls.push_back(wall);
      continue;
    }
    for (const Span& span : SpansLeft(wall.length_m, crossings, half_width_m))
      left.walls.push_back(PieceOf(wall, span));
  }
  return left;
}

LearnedWalls SureParts(const LearnedWalls& walls) {
  LearnedWalls sure = walls;
  for (LearnedWall& wall : sure.walls) wall.length_m -= 2 * std::min(2 * wall.sigma_end_m, kMostCut_m);
  std::erase_if(sure.walls, [](const LearnedWall& wall) { return wall.length_m < kLeastSure_m; });
  return sure;
}

}  // namespace priamos::planner
