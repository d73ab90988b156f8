#pragma once

#include "common/geometry.hpp"
#include "world/core/camera/optics.hpp"
#include "world/core/scene/device_faults.hpp"

namespace priamos::world {

/// The mast below the head as a damped oscillator per axis (Rao, "Mechanical Vibrations", chapter 3: a mass
/// on a spring whose foot is accelerated). At rest under a steady acceleration it leans `nod_deg_s2_m` per
/// m/s^2 against it: when the base brakes, the head nods.
class Mast {
 public:
  explicit Mast(const MastPlan& plan) : plan_(plan) {}

  /// Advances by `dt_s`, in which the base came to move at `velocity`.
  void Step(const Twist2& velocity, double dt_s);
  MastLean lean() const { return {pitch_.at_rad, roll_.at_rad}; }

 private:
  struct Swing {
    double at_rad = 0, rate_rad_s = 0;
  };
  void Step(Swing& swing, double rest_rad, double dt_s) const;

  MastPlan plan_;
  Twist2 before_;
  Swing pitch_, roll_;
};

}  // namespace priamos::world
