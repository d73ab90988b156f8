#pragma once

#include "common/robot/body_size.hpp"
#include "test/bench/rivals/rival_driver.hpp"

namespace priamos::bench {

/// Weights and limits of the dynamic window.
struct DynamicWindowConfig {
  double radius_m = 0;  ///< of the disc; 0: the true rectangle, which turns as it likes
  double margin_m = 0.05;
  double heading = 1, distance = 0.5, velocity = 0.3;  ///< weights of the objective
  double acceleration_m_s2 = 0.5, turn_acceleration_rad_s2 = 1.0, most_turn_rad_s = 0.5;
  double braking_m_s2 = 0.4;  ///< a velocity is admissible that can be braked before what it meets
  double window_s = 0.5;      ///< what can be reached in this time is the window
  double look_m = 1.5;        ///< free distance beyond which more is no better

  void Describe(Archive& a);
};

/// The dynamic window of Fox, Burgard and Thrun (IEEE Robotics and Automation Magazine, 1997) for a holonomic
/// base: of the velocities that can be reached within a moment and braked before they meet something, the one
/// that looks best: towards the target, far from obstacles on its way, fast. A disc chooses its
/// velocity in the plane, the rectangle its turn rate, too.
class DynamicWindow : public Method {
 public:
  explicit DynamicWindow(const DynamicWindowConfig& config) : config_(config) {}

  Twist2 Choose(const Situation& situation) override;
  bool turns() const override { return config_.radius_m <= 0; }

 private:
  double FreeDistance(const Situation& situation, const Twist2& twist) const;
  double FreeOfRectangle(const Situation& situation, const Twist2& twist) const;
  std::optional<double> Value(const Situation& situation, const Twist2& twist) const;
  std::vector<Twist2> Window(const Situation& situation) const;

  DynamicWindowConfig config_;
};

}  // namespace priamos::bench
