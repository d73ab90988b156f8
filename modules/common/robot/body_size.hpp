#pragma once

namespace priamos {

/// Size of the robot's body by its drawing [m]: a box around the base centre, x forward, over everything that
/// can touch. It is the default of each configuration that has a body. Robot, planner and simulated
/// world are configured separately, because a robot that was built differs from its drawing.
struct BodySize {
  double length_m = 0.95;  ///< along the base's x axis
  double width_m = 0.78;   ///< along the base's y axis
  double height_m = 1.35;  ///< top of the third camera, the tallest part: its axis is at 1.32 m
};

inline constexpr BodySize kDrawnBody{};

}  // namespace priamos
