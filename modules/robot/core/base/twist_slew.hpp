#pragma once

#include "common/archive.hpp"
#include "common/geometry.hpp"

namespace priamos::robot {

/// Fastest changes of the velocity: of driving in any direction, and of turning.
struct AccelerationLimits {
  double acceleration_m_s2 = 0.5;
  double turn_acceleration_rad_s2 = 1.0;

  void Describe(Archive& a);
};

/// Limits how fast the commanded velocity changes, so that a jump of the pose or a new path never jerks the
/// base. Works on the floor, not in the turning base frame: driving straight while turning is no
/// acceleration. Drive and turn change by the same part of what they are to change, so a base that sets off
/// does so in the direction of the target: a motion that is free stays free.
class TwistSlew {
 public:
  explicit TwistSlew(const AccelerationLimits& limits) : limits_(limits) {}

  void set_limits(const AccelerationLimits& limits) { limits_ = limits; }
  /// The velocity to command now, at most one limited step from the last one towards `target`.
  Twist2 Step(const Twist2& target, double dt_s);
  /// What was commanded in fact, after later filters: the next step starts there.
  void SetCommanded(const Twist2& twist) { commanded_ = twist; }
  const Twist2& commanded() const { return commanded_; }

 private:
  AccelerationLimits limits_;
  Twist2 commanded_;
};

}  // namespace priamos::robot
