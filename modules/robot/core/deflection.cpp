#include "robot/core/deflection.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos::robot {
namespace {

constexpr double kTolerated = 0.01;  ///< [m/s] what a projection that has not quite converged may be over

/// approach . (vx, vy, reach * wz) <= limit
struct ApproachLimit {
  Eigen::Vector3d approach;
  double limit;
};

/// What keeps `corner_or_side`, the part of the footprint nearest to a point, from getting through the point
/// along `normal`.
ApproachLimit LimitAlong(const DeflectionConfig& config, const Footprint& footprint,
                         const Eigen::Vector2d& corner_or_side, const Eigen::Vector2d& normal,
                         double distance) {
  const double a = config.braking_m_s2, lost = a * config.latency_s;
  const double turning =
      (corner_or_side.x() * normal.y() - corner_or_side.y() * normal.x()) / footprint.Reach();
  const double free = std::max(0.0, distance - config.gap_m);
  return {{normal.x(), normal.y(), turning}, std::sqrt(lost * lost + 2 * a * free) - lost};
}

/// A point beside a corner is out of the way as long as it stays before the one side or beside the other.
struct CornerLimits {
  ApproachLimit along_x, along_y;

  const ApproachLimit& Easier(const Eigen::Vector3d& motion) const {
    const double slack_x = along_x.limit - along_x.approach.dot(motion);
    const double slack_y = along_y.limit - along_y.approach.dot(motion);
    return slack_x >= slack_y ? along_x : along_y;
  }
};

struct Limits {
  std::vector<ApproachLimit> sides;
  std::vector<CornerLimits> corners;
};

Limits LimitsBy(const DeflectionConfig& config, const Footprint& footprint,
                std::span<const Eigen::Vector2d> points) {
  Limits limits;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d nearest = footprint.Nearest(point);
    const Eigen::Vector2d way = point - nearest;
    if (way.norm() > config.reach_m || way.norm() < 1e-3) continue;
    const Eigen::Vector2d x(way.x() < 0 ? -1 : 1, 0), y(0, way.y() < 0 ? -1 : 1);
    const ApproachLimit along_x = LimitAlong(config, footprint, nearest, x, std::abs(way.x()));
    const ApproachLimit along_y = LimitAlong(config, footprint, nearest, y, std::abs(way.y()));
    if (way.x() != 0 && way.y() != 0) {
      limits.corners.push_back({along_x, along_y});
    } else {
      limits.sides.push_back(way.x() != 0 ? along_x : along_y);
    }
  }
  return limits;
}

/// Nothing is turned round and nothing is done that was not wished: every part of the motion stays between 0
/// and the wish.
std::vector<ApproachLimit> LimitsByWish(const Eigen::Vector3d& wish) {
  std::vector<ApproachLimit> limits;
  for (int i = 0; i < 3; ++i) {
    limits.push_back({Eigen::Vector3d::Unit(i), std::max(0.0, wish(i))});
    limits.push_back({-Eigen::Vector3d::Unit(i), std::max(0.0, -wish(i))});
  }
  return limits;
}

/// Dykstra's cyclic projection onto half spaces: converges to the nearest point of their intersection (Boyle
/// and Dykstra, "A method for finding projections onto the intersection of convex sets", 1986).
Eigen::Vector3d Projected(const Eigen::Vector3d& wanted, const std::vector<ApproachLimit>& limits) {
  constexpr int kRounds = 40;
  Eigen::Vector3d at = wanted;
  std::vector<double> pushed(limits.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const Eigen::Vector3d& n = limits[i].approach;
      const Eigen::Vector3d before = at + n * pushed[i];
      const double push = std::max(0.0, (n.dot(before) - limits[i].limit) / n.squaredNorm());
      at = before - n * push;
      moved = std::max(moved, std::abs(push - pushed[i]));
      pushed[i] = push;
    }
    if (moved < 1e-5) break;
  }
  return at;
}

}  // namespace

void DeflectionConfig::Describe(Archive& a) {
  a.Number("gap_m", gap_m, {"m", 0, 0.5, "nearer than this nothing is approached"});
  a.Number("braking_m_s2", braking_m_s2, {"m/s^2", 0.05, 5, "braking before obstacles"});
  a.Number("latency_s", latency_s, {"s", 0, 1, "age of an echo when the wheels obey it"});
  a.Number("reach_m", reach_m, {"m", 0.2, 5, "points farther away do not deflect"});
}

Twist2 Deflected(const DeflectionConfig& config, const Footprint& footprint, const Twist2& wanted,
                 std::span<const Eigen::Vector2d> points) {
  const double reach = footprint.Reach();
  const Eigen::Vector3d wish(wanted.vx, wanted.vy, wanted.wz * reach);
  const Limits limits = LimitsBy(config, footprint, points);
  std::vector<ApproachLimit> all = LimitsByWish(wish);
  all.insert(all.end(), limits.sides.begin(), limits.sides.end());
  // Which way past a corner is open shows only when the sides have had their say.
  const Eigen::Vector3d by_sides = Projected(wish, all);
  for (const CornerLimits& corner : limits.corners) all.push_back(corner.Easier(by_sides));
  // The projection converges only in the limit: invent nothing, and scale down what is still too fast.
  Eigen::Vector3d at = Projected(wish, all).cwiseMin(wish.cwiseMax(0.0)).cwiseMax(wish.cwiseMin(0.0));
  double scale = 1;
  for (const ApproachLimit& limit : all) {
    const double approach = limit.approach.dot(at);
    const double tolerated = limit.limit + kTolerated;
    if (approach > tolerated) scale = std::min(scale, tolerated / approach);
  }
  at *= scale;
  return {at.x(), at.y(), at.z() / reach};
}

}  // namespace priamos::robot
