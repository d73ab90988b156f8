#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot/core/base/odometry.hpp"
#include "robot/core/sonar/placed_echo.hpp"

namespace priamos::robot {

/// How an estimate of two numbers follows one echo: its range, and the place of its sensor by that.
struct EchoGain {
  Eigen::Vector2d by_range{0, 0};  ///< per metre of range
  Eigen::Vector2d towards{0, 0};   ///< unit vector from the sensor to what echoed, frame of the odometry
};

/// Errors that all echoes of an estimate share.
struct SharedErrors {
  double sound_speed = 0.0023;    ///< sigma of the scale of all ranges, by the temperature
  double yaw_rad_per_m = 0.0037;  ///< sigma of the constant turn of the odometry per metre
};

/// What errors that many echoes (in order of time) have in common add to the covariance of a least squares
/// estimate from them, as seen from the base at the newest one: the random walk of the odometry's heading and
/// place between them, its constant turn, and the speed of sound.
Eigen::Matrix2d SharedCovariance(const std::vector<PlacedEcho>& echoes, const std::vector<EchoGain>& gains,
                                 const SharedErrors& shared, const OdometryNoise& noise);

}  // namespace priamos::robot
