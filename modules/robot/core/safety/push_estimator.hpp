#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <optional>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/mecanum.hpp"

namespace priamos::robot {

/// What is known of the motors and of the mass they move.
struct PushConfig {
  double mass_kg = 180;
  double newton_per_ampere = 20;      ///< force at the rim of a wheel per current of its drive
  double rolling_resistance = 0.015;  ///< of the weight

  void Describe(Archive& a);
};

/// The currents of the four drives at one time [A]; order of the wheels as in WheelSpeeds.
struct MotorCurrents {
  Time time{};
  std::array<double, 4> current_a{};
};

/// Estimates the force with which the base pushes against something: that of the wheels by their currents,
/// less what acceleration (by the encoders) and rolling take. Currents and acceleration are averaged over the
/// same 120 ms with the same triangular weights, so that a ramp of the speed leaves no residual.
class PushEstimator {
 public:
  PushEstimator(const PushConfig& config, const MecanumGeometry& geometry)
      : config_(config), geometry_(geometry) {}

  /// Takes the velocity of the base by its encoders (base frame) until `time`.
  void AddMotion(Time time, const Twist2& twist);
  void AddCurrents(const MotorCurrents& currents);

  /// Base frame: force along x and y [N], torque over the lever of the wheels [N]. None while the samples do
  /// not cover the window.
  std::optional<Eigen::Vector3d> Push() const;

 private:
  struct Motion {
    Time time{};
    Eigen::Vector3d travel_m;  ///< integral of (vx, vy, lever * wz)
  };
  /// Means over the window: velocity [m/s] and its derivative, as (x, y, lever * yaw).
  struct Means {
    Time from, middle, to;
    Eigen::Vector3d velocity, acceleration;
  };
  std::optional<Means> MeanMotion() const;
  std::optional<Eigen::Vector3d> MeanForce(const Means& means) const;
  Eigen::Vector3d Rolling(const Eigen::Vector3d& velocity) const;

  PushConfig config_;
  MecanumGeometry geometry_;
  std::deque<Motion> motions_;          ///< of the window, oldest first
  std::deque<MotorCurrents> currents_;  ///< of the window, oldest first
};

}  // namespace priamos::robot
