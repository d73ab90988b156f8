#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace priamos {

inline constexpr double kPi = std::numbers::pi;
constexpr double Radians(double degrees) {
  return degrees * kPi / 180;
}
constexpr double Degrees(double radians) {
  return radians * 180 / kPi;
}

/// The angle `rad` plus a multiple of 2 pi, in (-pi, pi].
inline double WrapAngle(double rad) {
  const double wrapped = std::remainder(rad, 2 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// A pose on the floor, or the transform `a_from_b`: x, y [m], yaw [rad], counter-clockwise positive.
/// `a_from_b * b_from_c` is `a_from_c`; `a_from_b * point_in_b` is the point in a.
struct Pose2 {
  double x = 0, y = 0, yaw = 0;

  Eigen::Vector2d translation() const { return {x, y}; }
  Eigen::Matrix2d rotation() const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return (Eigen::Matrix2d() << c, -s, s, c).finished();
  }
  Pose2 Inverse() const {
    const Eigen::Vector2d t = -(rotation().transpose() * translation());
    return {t.x(), t.y(), WrapAngle(-yaw)};
  }
  friend Eigen::Vector2d operator*(const Pose2& a_from_b, const Eigen::Vector2d& in_b) {
    return a_from_b.rotation() * in_b + a_from_b.translation();
  }
  friend Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
    const Eigen::Vector2d t = a_from_b * b_from_c.translation();
    return {t.x(), t.y(), WrapAngle(a_from_b.yaw + b_from_c.yaw)};
  }
};

/// Velocity on the floor in the base frame: vx, vy [m/s], wz [rad/s].
struct Twist2 {
  double vx = 0, vy = 0, wz = 0;
};

/// The pose after moving with constant body velocity for `seconds` (exact arc, not Euler).
Pose2 Integrate(const Pose2& pose, const Twist2& twist, double seconds);

/// Distance of `point` from the segment between `begin` and `end` [m], which may be the same point.
double DistanceToSegment(const Eigen::Vector2d& begin, const Eigen::Vector2d& end,
                         const Eigen::Vector2d& point);

}  // namespace priamos
