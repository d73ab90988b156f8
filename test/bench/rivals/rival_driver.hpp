#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "robot/core/base/odometry.hpp"
#include "robot/core/base/twist_slew.hpp"
#include "test/bench/rivals/driver.hpp"
#include "test/bench/rivals/echo_cloud.hpp"

namespace priamos::bench {

/// What a method for local motion decides on, base frame.
struct Situation {
  std::vector<Eigen::Vector2d> points;  ///< where echoes came from [m]
  Eigen::Vector2d target{0, 0};         ///< a place ahead on the path, at last its end [m]
  double way_rad = 0;                   ///< direction of the path, which the heading follows
  Twist2 commanded;                     ///< last
  double speed_m_s = 0;                 ///< of the path
};

/// A method for local motion: the velocity that it wants now, base frame. Those for a disc leave the turn to
/// the caller, who turns the base along.
class Method {
 public:
  virtual ~Method() = default;
  virtual Twist2 Choose(const Situation& situation) = 0;
  virtual bool turns() const { return false; }
};

/// What all rivals get beside their method.
struct RivalConfig {
  EchoCloudConfig echoes;
  double ahead_m = 1.5;          ///< the target is so far ahead on the path
  double turn_gain = 1.5;        ///< turn rate per angle between heading and the direction it follows [1/s]
  double most_turn_rad_s = 0.5;  ///< that of the robot
  bool along_motion = true;      ///< the heading follows the motion; else the path
  double slow_from_rad = 0.5;    ///< where the heading is farther off, it drives the slower
  int steps_per_choice = 2;      ///< of 20 ms

  void Describe(Archive& a);
};

/// A rival: odometry, echoes remembered, a target drawn along the path, limits of acceleration as the robot
/// has them, and a method of others in the middle.
class RivalDriver : public Driver {
 public:
  RivalDriver(const Order& order, const RivalConfig& config, std::unique_ptr<Method> method);

  std::optional<world::PerWheel> Step(const Heard& heard, Time now) override;

 private:
  void Hear(const Heard& heard, Time now);
  Situation Look();
  Twist2 Wanted();
  Twist2 Turned(Twist2 wanted, const Situation& situation) const;
  Eigen::Vector2d OnPath(double s) const;
  void Follow(const Eigen::Vector2d& at);

  RivalConfig config_;
  std::unique_ptr<Method> method_;
  robot::MecanumGeometry geometry_;
  robot::Odometry odometry_;
  EchoCloud echoes_;
  robot::TwistSlew slew_;
  Pose2 odom_from_map_;
  std::vector<Eigen::Vector2d> path_;  ///< map frame, from the start
  double length_m_ = 0, speed_m_s_ = 0, done_m_ = 0;
  Twist2 wanted_;
  int steps_ = 0;
};

}  // namespace priamos::bench
