#include "robot/core/pose/wall_update.hpp"

#include <cmath>
#include <limits>

#include "robot/core/pose/joseph.hpp"

namespace priamos::robot {
namespace {

using Matrix = PoseState::Matrix;

int IndexOf(int wall) {
  return PoseState::kOwn + 2 * wall;
}

/// A unit vector turned by a quarter, the derivative of the vector by its angle.
Eigen::Vector2d Turned(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

/// `covariance` with two rows and columns more, for numbers whose derivative by the state is `by_state`.
Matrix Extended(const Matrix& covariance, const Derivative<2>& by_state, const Eigen::Matrix2d& own) {
  const auto n = covariance.rows();
  Matrix extended(n + 2, n + 2);
  extended.topLeftCorner(n, n) = covariance;
  extended.bottomLeftCorner(2, n) = by_state * covariance;
  extended.topRightCorner(n, 2) = extended.bottomLeftCorner(2, n).transpose();
  extended.bottomRightCorner(2, 2) = by_state * covariance * by_state.transpose() + own;
  return extended;
}

Matrix Without(const Matrix& covariance, int index) {
  const auto behind = covariance.rows() - index - 2;
  Matrix rest(covariance.rows() - 2, covariance.cols() - 2);
  rest.topLeftCorner(index, index) = covariance.topLeftCorner(index, index);
  rest.topRightCorner(index, behind) = covariance.topRightCorner(index, behind);
  rest.bottomLeftCorner(behind, index) = covariance.bottomLeftCorner(behind, index);
  rest.bottomRightCorner(behind, behind) = covariance.bottomRightCorner(behind, behind);
  return rest;
}

}  // namespace

Eigen::Vector2d WallLine::normal() const {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

WallLine WallOf(const PoseState& state, int wall) {
  return {state.mean(IndexOf(wall)), state.mean(IndexOf(wall) + 1),
          state.anchors[static_cast<std::size_t>(wall)]};
}

PoseState WithWall(const PoseState& state, const WallSeen& seen) {
  PoseState next = state;
  next.mean.conservativeResize(state.size() + 2);
  next.mean.tail<2>() << WrapAngle(state.pose().yaw + seen.bearing_rad), seen.distance_m;
  next.anchors[static_cast<std::size_t>(state.walls())] = state.pose().translation();
  // Distance from the anchor: the base may be elsewhere than it believes, the anchor is where it is.
  const WallLine wall = WallOf(next, state.walls());
  Derivative<2> by_state = Derivative<2>::Zero(2, state.size());
  by_state(0, 2) = 1;
  by_state.row(1).head<2>() = wall.normal().transpose();
  next.covariance = Extended(state.covariance, by_state, seen.covariance);
  next.repeated = Extended(state.repeated, by_state, Eigen::Matrix2d::Zero());
  return next;
}

PoseState WithoutWall(const PoseState& state, int wall) {
  PoseState next = state;
  const int index = IndexOf(wall), behind = state.size() - index - 2;
  next.mean.resize(state.size() - 2);
  next.mean << state.mean.head(index), state.mean.tail(behind);
  next.covariance = Without(state.covariance, index);
  next.repeated = Without(state.repeated, index);
  for (auto i = static_cast<std::size_t>(wall); i + 1 < next.anchors.size(); ++i)
    next.anchors[i] = state.anchors[i + 1];
  return next;
}

std::optional<int> SameWall(const PoseState& state, const WallSeen& seen) {
  constexpr double kAngle = Radians(6), kDistance_m = 0.15;
  for (int i = 0; i < state.walls(); ++i) {
    const WallLine wall = WallOf(state, i);
    const double distance = wall.distance_m - wall.normal().dot(state.pose().translation() - wall.anchor);
    if (std::abs(WrapAngle(wall.angle_rad - state.pose().yaw - seen.bearing_rad)) < kAngle &&
        std::abs(distance - seen.distance_m) < kDistance_m)
      return i;
  }
  return std::nullopt;
}

RangeUpdate Updated(const PoseState& prior, int wall, const RangeSeen& seen) {
  const WallLine line = WallOf(prior, wall);
  const Eigen::Vector2d arm = prior.pose().rotation() * seen.base_from_sonar.translation();
  const Eigen::Vector2d from_anchor = prior.pose().translation() + arm - line.anchor;
  Derivative<1> h = Derivative<1>::Zero(1, prior.size());
  h.head<2>() = -line.normal().transpose();
  h(2) = -line.normal().dot(Turned(arm));
  h(IndexOf(wall)) = -Turned(line.normal()).dot(from_anchor);
  h(IndexOf(wall) + 1) = 1;

  const double residual = seen.range_m - (line.distance_m - line.normal().dot(from_anchor));
  const Eigen::Matrix<double, 1, 1> variance(seen.sigma_m * seen.sigma_m);
  const double spread = (h * prior.covariance * h.transpose())(0) + variance(0);
  const Gain<1> gain = prior.covariance * h.transpose() / spread;
  RangeUpdate update{prior, std::abs(residual) / std::sqrt(spread)};
  update.state.mean += gain * residual;
  update.state.mean(2) = WrapAngle(update.state.mean(2));
  update.state.covariance = Joseph<1>(gain, h, prior.covariance, variance);
  update.state.repeated = Joseph<1>(gain, h, prior.repeated, Eigen::Matrix<double, 1, 1>::Zero());
  return update;
}

namespace {

/// The nearest wall whose normal lies within `most_rad` of a sonar's axis, on the side where it looks.
std::optional<int> WallBefore(const PoseState& state, const Pose2& base_from_sonar, double most_rad) {
  const Pose2 map_from_sonar = state.pose() * base_from_sonar;
  std::optional<int> before;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < state.walls(); ++i) {
    const WallLine wall = WallOf(state, i);
    const double range = wall.distance_m - wall.normal().dot(map_from_sonar.translation() - wall.anchor);
    if (std::abs(WrapAngle(wall.angle_rad - map_from_sonar.yaw)) > most_rad || range <= 0 || range > nearest)
      continue;
    before = i;
    nearest = range;
  }
  return before;
}

}  // namespace

void WallRangeConfig::Describe(Archive& a) {
  a.Number("most_bearing_deg", most_bearing_deg,
           {"deg", 1, 20, "angle between a sonar's axis and the normal of the wall it hears"});
  a.Number("gate_distance", gate_distance,
           {"-", 1, 10, "Mahalanobis distance beyond which a range is not the wall's"});
}

CycleUpdate Updated(const PoseState& prior, const std::vector<RangeSeen>& ranges,
                    const WallRangeConfig& config) {
  CycleUpdate update{prior, {}};
  for (const RangeSeen& seen : ranges) {
    const auto wall = WallBefore(update.state, seen.base_from_sonar, Radians(config.most_bearing_deg));
    if (!wall) continue;
    const RangeUpdate by_range = Updated(update.state, *wall, seen);
    // Written so that NaN is refused.
    if (!(by_range.distance <= config.gate_distance)) continue;
    update.state = by_range.state;
    update.heard.set(static_cast<std::size_t>(*wall));
  }
  return update;
}

}  // namespace priamos::robot
