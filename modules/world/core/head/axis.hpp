#pragma once

#include "common/archive.hpp"
#include "common/random.hpp"
#include "common/time.hpp"

namespace priamos::world {

/// One motor with its gear. Lengths are in the unit of the axis: rad, or motor steps for zoom and focus.
struct AxisConfig {
  double min = 0, max = 0;   ///< end stops
  double step = 0;           ///< one motor step
  double speed = 0;          ///< per second
  double acceleration = 0;   ///< per second squared
  double backlash = 0;       ///< full play between motor and axis
  double repeatability = 0;  ///< standard deviation of where the axis rests at the same motor position
};

/// An axis turned by an angle; keys in rad.
struct AngleAxisConfig : AxisConfig {
  void Describe(Archive& a);
};

/// Zoom or focus; keys in motor steps.
struct LensAxisConfig : AxisConfig {
  void Describe(Archive& a);
};

/// A stepper motor that drives an axis through a gear with play. The step counter knows the motor; the axis
/// rests up to half the play behind it, on the side it came from (that is why a setting is best approached
/// always from the same side; Wilson 1993).
class Axis {
 public:
  /// Axis at rest; the motor stands at `start` [unit of the axis], the axis anywhere within the play.
  Axis(const AxisConfig& config, double start, Rng rng);

  /// New set value, clamped to the end stops and rounded to a step. Must be finite.
  void MoveTo(double target);
  void Step(Duration step);

  bool moving() const { return moving_; }
  /// Position by the step counter.
  double counter() const;
  /// True position of the axis.
  double position() const { return axis_ + rest_error_; }

 private:
  AxisConfig config_;
  Rng rng_;
  double target_, motor_, speed_ = 0, axis_, rest_error_;
  bool moving_ = false;
};

}  // namespace priamos::world
