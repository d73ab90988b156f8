#pragma once

#include <array>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/robot_drawing.hpp"

namespace priamos::robot {

/// Turn rates of the wheels [rad/s]: front left, front right, rear left, rear right; positive drives forward.
using WheelSpeeds = std::array<double, 4>;

/// A base on four Mecanum wheels whose rollers form an X seen from above (ground contact: an O), so that the
/// front left and rear right wheel push to the right when driving forward.
struct MecanumGeometry {
  double wheel_radius_m = kDrawnWheels.radius_m;
  /// Half wheelbase + half track: the lever of a wheel's rim speed about the centre.
  double lever_m = kDrawnWheels.half_wheelbase_m + kDrawnWheels.half_track_m;
  double max_wheel_rad_s = kDrawnWheels.max_rad_s;

  void Describe(Archive& a);
};

/// Motion of the base computed from four wheels.
struct WheelMotion {
  Twist2 twist;         ///< least squares over the four wheels, base frame
  double slip_m_s = 0;  ///< residual of the fourth equation; 0 when all rollers roll
};

/// Wheel speeds that produce `twist` when all rollers roll. Not limited.
WheelSpeeds ToWheelSpeeds(const MecanumGeometry& geometry, const Twist2& twist);

/// The inverse of ToWheelSpeeds. Four wheels determine three degrees of freedom: front left + front right -
/// rear left - rear right is 0 for every motion that rolls, so the rest of that sum measures slip.
WheelMotion FromWheelSpeeds(const MecanumGeometry& geometry, const WheelSpeeds& speeds);

/// Scales all wheels by one factor so that none exceeds the limit: the twist keeps its direction, the base
/// its path.
WheelSpeeds Saturated(const MecanumGeometry& geometry, const WheelSpeeds& speeds);

}  // namespace priamos::robot
