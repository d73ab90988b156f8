#pragma once

#include "robot/core/base/odometry.hpp"

namespace priamos::robot {

/// What the wheels say of the way between two fixes, and how far slip may make that wrong.
class WheelsBetween {
 public:
  /// The next step. The slip keeps its sign for a while: it adds up with the turn that it has made already.
  void Add(const OdometryStep& step);

  double turn_rad() const { return turn_rad_; }
  double forward_m() const { return forward_m_; }
  /// Of the turn, by slip as configured [rad^2].
  double variance() const { return variance_; }
  /// Whether encoders were credible all the way.
  bool usable() const { return usable_; }

 private:
  double turn_rad_ = 0, forward_m_ = 0, variance_ = 0;
  bool usable_ = true;
  double slip_ = 0, with_turn_ = 0;  ///< variance of the slip, and its covariance with the turn
  bool begun_ = false;
};

}  // namespace priamos::robot
