#include "robot/core/features/feature.hpp"

#include <Eigen/LU>
#include <cmath>

namespace priamos::robot {
namespace {

Eigen::Matrix2d Outer(const Eigen::Vector2d& v) {
  return v * v.transpose();
}

/// How the middle of a wall (across, to the left) and its direction follow a turn about a point that lies
/// `lever_m` behind the middle along the wall.
Eigen::Vector2d ByTurn(double lever_m) {
  return {lever_m, 1};
}

/// A feature by the base at one time, which knows it with the covariance `own`.
Feature By(const Whereabouts& base, int id, const HeardFeature& heard, const Eigen::Matrix2d& own) {
  const Pose2 map_from_odom = base.map_from_base * base.odom_from_base.Inverse();
  const Eigen::Vector2d middle = map_from_odom * ((heard.from + heard.to) / 2);
  const double yaw = WrapAngle(map_from_odom.yaw + heard.line.angle_rad + kPi / 2);
  const Eigen::Vector2d along(std::cos(yaw), std::sin(yaw)), left(-along.y(), along.x());
  Eigen::Matrix<double, 2, 3> by_pose = Eigen::Matrix<double, 2, 3>::Zero();
  by_pose.topLeftCorner<1, 2>() = left.transpose();
  by_pose.col(2) = ByTurn(along.dot(middle - base.map_from_base.translation()));
  return {id,
          heard.heard,
          {middle.x(), middle.y(), yaw},
          (heard.to - heard.from).norm(),
          own + by_pose * base.covariance * by_pose.transpose(),
          heard.end_sigma_m};
}

/// Of the middle and the direction, from that of angle and distance at the anchor.
Eigen::Matrix2d AtMiddle(const HeardFeature& heard) {
  const double along_m = heard.line.along().dot((heard.from + heard.to) / 2 - heard.line.anchor);
  Eigen::Matrix2d by_line;
  by_line << along_m, -1, 1, 0;
  return by_line * heard.line.covariance * by_line.transpose();
}

/// What the odometry has lost between two times: its turns lie anywhere between both places of the base.
Eigen::Matrix2d Lost(const HeardFeature& heard, const Whereabouts& now, const OdometryNoise& noise) {
  const double driven_m = std::max(0.0, now.travel_m - heard.heard_at.travel_m);
  Eigen::Matrix2d lost = Eigen::Matrix2d::Zero();
  lost(0, 0) = std::pow(noise.drift_m_per_sqrt_m, 2) * driven_m;
  for (const Whereabouts& base : {heard.heard_at, now}) {
    const Eigen::Vector2d arm = (heard.from + heard.to) / 2 - base.odom_from_base.translation();
    lost += Outer(ByTurn(heard.line.along().dot(arm))) * std::pow(noise.yaw_rad_per_sqrt_m, 2) * driven_m / 2;
  }
  return lost;
}

}  // namespace

HeardFeature HeardFeatureOf(const FoundSegment& found, const Whereabouts& heard_at) {
  const WallSegment& wall = found.wall;
  return {wall.line(), wall.from(), wall.to(), wall.end_sigma_m(), wall.grows(), found.heard, heard_at};
}

/// Its direction is known as well as that of the base from which it is told.
HeardFeature HeardFeatureOf(const FoundPoint& found, const Whereabouts& heard_at) {
  constexpr double kYawVariance = 1e-6;
  const double variance = found.fit.covariance.trace();  // the larger one of both directions is less
  SegmentLine line{.angle_rad = found.facing_rad, .anchor = found.fit.at};
  line.covariance = Eigen::Vector2d(kYawVariance, variance).asDiagonal();
  return {line, found.fit.at, found.fit.at, std::sqrt(variance), true, found.heard, heard_at};
}

Feature InMap(int id, const HeardFeature& heard, const Whereabouts& now, const OdometryNoise& noise) {
  const Eigen::Matrix2d own = AtMiddle(heard);
  const Feature then = By(heard.heard_at, id, heard, own);
  const Feature later = By(now, id, heard, own + Lost(heard, now, noise));
  return later.covariance.determinant() < then.covariance.determinant() ? later : then;
}

}  // namespace priamos::robot
