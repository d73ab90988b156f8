#pragma once

#include "common/archive.hpp"
#include "common/random.hpp"
#include "world/core/base/drive_board.hpp"

namespace priamos::world {

/// What the motors push, and how their currents show it. `robot` knows the nominal mass.
struct MotorLoadConfig {
  double mass_kg = 180;
  double mass_error = 0.1;  ///< what the robot carries or lacks, drawn once per run
  double traction = 0.6;
  double full_slide_m_s = 0.02;
  double rolling_resistance = 0.015;
  double newton_per_ampere = 20;
  double lag_s = 0.01;
  double noise_a = 0.3;
  double offset_a = 0.2;

  void Describe(Archive& a);
};

/// The force that each wheel puts on the floor along its rolling direction, and the current that its drive
/// takes for it. A wheel accelerates its quarter of the mass and overcomes its rolling resistance. Where a
/// solid holds the base, the wheel slides: its friction grows with the sliding speed up to what the floor
/// takes (creepage: Johnson, "Contact Mechanics", Cambridge 1985, chapter 8), and the wheel no longer
/// accelerates the mass.
class MotorLoad {
 public:
  MotorLoad(const MotorLoadConfig& config, Rng rng);

  /// Advances by `dt_s`, in which the wheels rolled at `rolled_m_s` and slid over the floor at `slid_m_s`.
  void Step(const PerWheel& rolled_m_s, const PerWheel& slid_m_s, double dt_s);
  /// From now on this motor is off or has no load: it takes no current.
  void Release(std::size_t wheel) { released_.at(wheel) = true; }
  /// The currents as one reading gives them [A].
  PerWheel Read();

 private:
  MotorLoadConfig config_;
  Rng rng_;
  double mass_kg_;
  PerWheel offset_a_{}, rolled_m_s_{}, current_a_{};
  std::array<bool, 4> released_{};
};

}  // namespace priamos::world
