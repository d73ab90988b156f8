#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"

namespace priamos::world {

/// A sensor of the ring that breaks.
struct SonarFault {
  static constexpr int kAny = 0;

  int sensor = 1;  ///< 1 to 24, S1 ahead, counter-clockwise; kAny: drawn from the seed
  std::string kind = "dead";
  double at_s = 0;      ///< since the world began
  double deaf_db = 30;  ///< what a deaf one hears less
  double chance = 1;    ///< it breaks in this part of the runs

  void Describe(Archive& a);
};

/// A drive that breaks.
struct MotorFault {
  std::string wheel = "front_left";
  std::string kind = "stalled";
  double at_s = 0;  ///< since the world began

  void Describe(Archive& a);
  /// Place of the wheel in messages.
  std::size_t index() const;
};

/// The head stands on a mast that is not stiff: it nods when the base brakes, and swings on.
struct MastPlan {
  double nod_deg_s2_m = 0;  ///< deflection at rest per acceleration
  double frequency_hz = 4;
  double damping = 0.08;

  void Describe(Archive& a);
};

/// What breaks in this world.
struct FaultsPlan {
  std::vector<SonarFault> sonars;
  std::vector<MotorFault> motors;

  void Describe(Archive& a);
};

}  // namespace priamos::world
