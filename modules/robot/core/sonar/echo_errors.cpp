#include "robot/core/sonar/echo_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace priamos::robot {
namespace {

/// Wheels slip for some decimetres in the same sense: over a few metres a walk of independent steps, which
/// the noise of the odometry describes, would be longer.
constexpr double kWalked = 0.8;

Eigen::Matrix2d Outer(const Eigen::Vector2d& v) {
  return v * v.transpose();
}

/// A quarter turn to the left.
Eigen::Vector2d Left(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

}  // namespace

/// An error of the odometry's heading between two echoes turns the places of all earlier ones about where the
/// base was then; one of its place shifts them.
Eigen::Matrix2d SharedCovariance(const std::vector<PlacedEcho>& echoes, const std::vector<EchoGain>& gains,
                                 const SharedErrors& shared, const OdometryNoise& noise) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero(), by_place = Eigen::Matrix2d::Zero();
  Eigen::Vector2d about_origin(0, 0), by_sound(0, 0), by_turn(0, 0);
  for (std::size_t k = 0; k < echoes.size(); ++k) {
    const EchoGain& gain = gains[k];
    by_place += gain.by_range * gain.towards.transpose();
    about_origin += gain.by_range * gain.towards.dot(Left(echoes[k].odom_from_sonar.translation()));
    by_sound += gain.by_range * echoes[k].range_m;
    if (k + 1 == echoes.size()) break;
    const Pose2 &base = echoes[k].odom_from_base, &next = echoes[k + 1].odom_from_base;
    const double driven_m = std::max(0.0, echoes[k + 1].travel_m - echoes[k].travel_m);
    const double walked_m = kWalked * driven_m;
    const double turned_rad = std::abs(WrapAngle(next.yaw - base.yaw));
    const Eigen::Vector2d by_heading = about_origin - by_place * Left(base.translation());
    covariance += Outer(by_heading) * (std::pow(noise.yaw_rad_per_sqrt_m, 2) * walked_m +
                                       std::pow(noise.yaw_rad_per_sqrt_rad, 2) * turned_rad);
    covariance += by_place * by_place.transpose() * std::pow(noise.drift_m_per_sqrt_m, 2) * walked_m;
    by_turn += by_heading * driven_m;
  }
  return covariance + Outer(by_sound) * std::pow(shared.sound_speed, 2) +
         Outer(by_turn) * std::pow(shared.yaw_rad_per_m, 2);
}

}  // namespace priamos::robot
