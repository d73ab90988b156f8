#pragma once

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/robot/robot_drawing.hpp"
#include "world/core/base/drive_board.hpp"

namespace priamos::world {

/// The base and the errors of its construction. The nominal values are known to `robot`; the
/// errors are drawn once per run from the seed.
struct MecanumConfig {
  double wheel_radius_m = kDrawnWheels.radius_m;
  double half_wheelbase_m = kDrawnWheels.half_wheelbase_m;
  double half_track_m = kDrawnWheels.half_track_m;
  double radius_error = 0.008;
  double lever_error = 0.01;
  double lateral_loss = 0.03;
  double roller_slip = 0.012;
  double slip_length_m = 0.3;
  double acceleration_slip_s2_m = 0.01;

  void Describe(Archive& a);
};

/// Four Mecanum wheels (rollers at 45 degrees, O arrangement seen from the contact points) on a flat floor.
///
/// A wheel's contact speed c = radius * speed * (1 - slip). Rolling without slip means
///   c_fl = vx - vy - k wz,  c_fr = vx + vy + k wz,  c_rl = vx + vy - k wz,  c_rr = vx - vy + k wz
/// with k = half wheelbase + half track (Muir and Neuman, "Kinematic modeling of wheeled mobile robots",
/// J. Robotic Systems 1987). Four slipping wheels contradict each other; the base takes the least squares
/// motion, which is where equal roller friction balances.
class MecanumBase {
 public:
  MecanumBase(const MecanumConfig& config, Rng rng);

  /// From now on this wheel is not driven: it rolls as the others move the base.
  void Loosen(std::size_t wheel) { loose_.at(wheel) = true; }
  /// True body velocity while the wheels turn so; slip wanders with the distance that each wheel rolls.
  Twist2 Step(const PerWheel& speed_rad_s, double dt_s);
  /// Speeds of the floor below the four contacts, along their rolling directions, while the base moves so.
  PerWheel ContactSpeeds(const Twist2& twist) const;
  /// What the rims of the wheels rolled in the last step [m/s]; a loose one as the base moves.
  PerWheel RimSpeeds() const { return previous_m_s_; }

 private:
  void RollLoose(double dt_s, PerWheel& contact_m_s);

  MecanumConfig config_;
  Rng rng_;
  double lever_m_;
  double lateral_loss_;
  PerWheel radius_m_, slip_{}, previous_m_s_{};
  std::array<bool, 4> loose_{};
  Twist2 twist_;  ///< of the last step
};

}  // namespace priamos::world
