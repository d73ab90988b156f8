#include "robot/core/base/mecanum.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {

void MecanumGeometry::Describe(Archive& a) {
  a.Number("wheel_radius_m", wheel_radius_m, {"m", 0.02, 0.5, "nominal radius of the wheels"});
  a.Number("lever_m", lever_m, {"m", 0.1, 2, "half wheelbase + half track"});
  a.Number("max_wheel_rad_s", max_wheel_rad_s, {"rad/s", 1, 30, "fastest turn rate of a wheel"});
}

WheelSpeeds ToWheelSpeeds(const MecanumGeometry& geometry, const Twist2& twist) {
  const double turn = geometry.lever_m * twist.wz;
  const double r = geometry.wheel_radius_m;
  return {(twist.vx - twist.vy - turn) / r, (twist.vx + twist.vy + turn) / r,
          (twist.vx + twist.vy - turn) / r, (twist.vx - twist.vy + turn) / r};
}

WheelMotion FromWheelSpeeds(const MecanumGeometry& geometry, const WheelSpeeds& speeds) {
  const auto [fl, fr, rl, rr] = speeds;
  const double quarter = geometry.wheel_radius_m / 4;
  return {{quarter * (fl + fr + rl + rr), quarter * (-fl + fr + rl - rr),
           quarter * (-fl + fr - rl + rr) / geometry.lever_m},
          quarter * (fl + fr - rl - rr)};
}

WheelSpeeds Saturated(const MecanumGeometry& geometry, const WheelSpeeds& speeds) {
  double fastest = 0;
  for (const double speed : speeds) fastest = std::max(fastest, std::abs(speed));
  if (fastest <= geometry.max_wheel_rad_s) return speeds;
  WheelSpeeds scaled = speeds;
  for (double& speed : scaled) speed *= geometry.max_wheel_rad_s / fastest;
  return scaled;
}

}  // namespace priamos::robot
