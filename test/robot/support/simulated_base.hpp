#pragma once

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/time.hpp"
#include "robot/core/base/mecanum.hpp"
#include "robot/core/base/odometry.hpp"

namespace priamos::robot {

/// A small Mecanum base for closed-loop tests: wheels of slightly different radii that slip, follow their
/// set values with a lag and a limited slope, and stop when commands stay away.
class SimulatedBase {
 public:
  struct Errors {
    double radius = 0.008;        ///< each radius off by up to this part
    double lever = 0.01;          ///< wheelbase + track off by up to this part
    double sideways_loss = 0.03;  ///< up to this part of sideways motion is lost
    double slip = 0.012;          ///< sigma of each wheel's wandering slip
    double slip_length_m = 0.3;   ///< distance after which the slip is forgotten
  };

  SimulatedBase(std::uint64_t seed, const Pose2& start) : SimulatedBase(seed, start, Errors()) {}
  SimulatedBase(std::uint64_t seed, const Pose2& start, const Errors& errors);

  void Command(const WheelSpeeds& speeds, Time now);
  /// Advances by `time` in steps of 2 ms.
  void Advance(Duration time);
  WheelSample Read() const;

  Time now() const { return now_; }
  const Pose2& truth() const { return truth_; }
  const Twist2& twist() const { return twist_; }

 private:
  void Step(double dt);

  Errors errors_;
  Rng rng_;
  MecanumGeometry nominal_;
  double lever_m_;
  double sideways_loss_;
  WheelSpeeds radius_m_{}, slip_{}, set_{}, ramp_{}, speed_{}, turned_{};
  Time now_;
  Time commanded_;
  Pose2 truth_;
  Twist2 twist_;
};

}  // namespace priamos::robot
