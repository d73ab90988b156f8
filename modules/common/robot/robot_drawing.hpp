#pragma once

namespace priamos {

/// Base and head of the robot by its drawing; body_size.hpp has its body. These are the defaults of
/// configurations. Robot, head and simulated world are configured separately, because a robot that was built
/// differs from its drawing.

/// The four Mecanum wheels, their drives and encoders.
struct DrawnWheels {
  double radius_m = 0.10;
  double half_wheelbase_m = 0.30;  ///< from the base centre to an axle, along x
  double half_track_m = 0.32;      ///< from the base centre to the middle of a wheel, along y
  double max_rad_s = 12;           ///< fastest turn
  int ticks_per_turn = 4096;       ///< of an encoder, with its gear
};

/// Where the fan of the line laser begins, base frame [m].
struct DrawnLaser {
  double x_m = 0.46, y_m = 0, z_m = 0.60;
};

/// Axes of the KASTOR head, and how far its motors go.
struct DrawnHead {
  double x_m = 0.25, y_m = 0, z_m = 1.20;  ///< where pan and tilt axis meet, base frame
  double half_stereo_base_m = 0.15;        ///< from the tilt axis' middle to a vergence axis, along y
  double third_above_m = 0.12;             ///< the third camera above the other two
  double most_pan_rad = 2, most_tilt_rad = 0.8, most_vergence_rad = 0.4;  ///< to both sides of 0
  int most_step = 2000;                                                   ///< of zoom and focus, from 0
};

inline constexpr DrawnWheels kDrawnWheels{};
inline constexpr DrawnLaser kDrawnLaser{};
inline constexpr DrawnHead kDrawnHead{};

}  // namespace priamos
