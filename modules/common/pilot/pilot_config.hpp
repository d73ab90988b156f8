#pragma once

#include <string>

#include "common/archive.hpp"
#include "common/pilot/stick.hpp"

namespace priamos {

/// Which axis of the stick moves one degree of freedom.
struct AxisUse {
  std::string axis;
  bool inverted = false;

  AxisUse(std::string name = "forward", bool invert = false) : axis(std::move(name)), inverted(invert) {}
  void Describe(Archive& a);
};

/// Curve from deflection to wish: nothing inside the dead band, then a straight line blended with a cubic
/// one.
struct AxisShape {
  double dead_band = 0.08;  ///< share of the full deflection
  double expo = 0.4;        ///< 0 straight, 1 purely cubic: fine near the middle

  void Describe(Archive& a);
  /// -1..1 to -1..1; odd, monotonic, 0 within the dead band, +-1 at full deflection.
  double operator()(double deflection) const;
};

/// Full deflection in one speed range.
struct SpeedRange {
  double speed_m_s = 0.25;
  double turn_rad_s = 0.3;

  SpeedRange(double speed = 0.25, double turn = 0.3) : speed_m_s(speed), turn_rad_s(turn) {}
  void Describe(Archive& a);
};

/// Numbers of the buttons; -1: none.
struct ButtonUse {
  int dead_man = 0;
  int mode = 1;
  int estop = 2;
  int take_over = 3;
  int range = 4;
  int rearm = 5;

  void Describe(Archive& a);
};

/// Axes of the stick for the base frame's velocities: forward, left, counter-clockwise.
struct BaseAxes {
  AxisUse vx{"forward"}, vy{"left"}, turn{"turn"};

  void Describe(Archive& a);
};

/// Axes of the stick for the head, and its speeds at full deflection.
struct HeadAxes {
  AxisUse pan{"turn"}, tilt{"pitch"}, vergence{"roll"}, zoom{"forward"}, focus{"up"};
  double pan_rad_s = 0.5, tilt_rad_s = 0.3, vergence_rad_s = 0.1;
  double zoom_step_s = 300, focus_step_s = 300;

  void Describe(Archive& a);
};

/// How a stick becomes commands: rates, waiting times, shape and use of axes and buttons.
struct PilotConfig {
  double rate_hz = 20;
  double rest_rate_hz = 2;
  double time_to_live_s = 0.2;
  double silence_s = 0.15;
  double rearm_hold_s = 1.0;
  double status_stale_s = 2.0;
  AxisShape shape;
  SpeedRange slow, fast{0.6, 0.7};
  ButtonUse buttons;
  BaseAxes base;
  HeadAxes head;

  void Describe(Archive& a);
};

}  // namespace priamos
