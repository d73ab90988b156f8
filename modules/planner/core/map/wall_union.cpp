#include "planner/core/map/wall_union.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos::planner {
namespace {

/// Least sigmas, so that a covariance which a radio rounded to nothing can be inverted.
constexpr double kLeast_m = 0.002, kLeast_rad = 0.0005;

/// A line beside a reference point: place across it (positive to the left) and direction.
struct LineAt {
  Eigen::Vector2d value{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
};

/// The line of `wall` as seen from `reference`, whose x axis is nearly parallel to it.
LineAt LineOf(const LearnedWall& wall, const Pose2& reference) {
  const Pose2 own = reference.Inverse() * wall.map_from_wall();
  Eigen::Matrix2d by_wall;
  by_wall << 1, -own.x, 0, 1;
  Eigen::Matrix2d covariance = wall.covariance();
  covariance.diagonal() += Eigen::Vector2d(kLeast_m * kLeast_m, kLeast_rad * kLeast_rad);
  return {{own.y - own.x * std::tan(own.yaw), own.yaw}, by_wall * covariance * by_wall.transpose()};
}

struct Stretch {
  double low = 0, high = 0;
};

Stretch StretchOf(const LearnedWall& wall, const Pose2& reference) {
  const double x = (reference.Inverse() * wall.map_from_wall()).x;
  return {x - wall.length_m / 2, x + wall.length_m / 2};
}

/// The combination of the smallest determinant.
LineAt Intersected(const LineAt& a, const LineAt& b) {
  constexpr int kSteps = 20;
  LineAt best;
  double least = std::numeric_limits<double>::infinity();
  const Eigen::Matrix2d of_a = a.covariance.inverse(), of_b = b.covariance.inverse();
  for (int i = 0; i <= kSteps; ++i) {
    const double weight = double(i) / kSteps;
    const Eigen::Matrix2d covariance = (weight * of_a + (1 - weight) * of_b).inverse();
    if (covariance.determinant() >= least) continue;
    least = covariance.determinant();
    best = {covariance * (weight * of_a * a.value + (1 - weight) * of_b * b.value), covariance};
  }
  return best;
}

}  // namespace

WallOffset OffsetOf(const LearnedWall& a, const LearnedWall& b) {
  const Pose2 frame = a.map_from_wall();
  const Stretch of_a = StretchOf(a, frame), of_b = StretchOf(b, frame);
  const double low = std::max(of_a.low, of_b.low), high = std::min(of_a.high, of_b.high);
  const Pose2 reference = frame * Pose2{(low + high) / 2, 0, 0};
  const LineAt line_a = LineOf(a, reference), line_b = LineOf(b, reference);
  const Eigen::Vector2d difference = line_b.value - line_a.value;
  const Eigen::Matrix2d covariance = line_a.covariance + line_b.covariance;
  return {difference.x(), difference.y(), low - high,
          std::sqrt(difference.dot(covariance.inverse() * difference))};
}

LearnedWall UnionOf(const LearnedWall& a, const LearnedWall& b) {
  const Pose2 frame = a.map_from_wall();
  const Stretch of_a = StretchOf(a, frame), of_b = StretchOf(b, frame);
  const Stretch all{std::min(of_a.low, of_b.low), std::max(of_a.high, of_b.high)};
  const Pose2 reference = frame * Pose2{(all.low + all.high) / 2, 0, 0};
  const LineAt line = Intersected(LineOf(a, reference), LineOf(b, reference));
  const Pose2 middle = reference * Pose2{0, line.value.x(), line.value.y()};
  LearnedWall one = a;
  one.x_m = middle.x;
  one.y_m = middle.y;
  one.yaw_deg = Degrees(middle.yaw);
  one.length_m = all.high - all.low;
  one.SetCovariance(line.covariance);
  one.sigma_end_m = std::max(a.sigma_end_m, b.sigma_end_m);
  one.seen_s = std::max(a.seen_s, b.seen_s);
  one.sightings = a.sightings + b.sightings;
  return one;
}

}  // namespace priamos::planner
