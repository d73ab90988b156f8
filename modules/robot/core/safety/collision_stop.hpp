#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/braking_law.hpp"
#include "robot/core/base/footprint.hpp"

namespace priamos::robot {

/// Margins that are kept free, and the braking before obstacles.
struct CollisionStopConfig {
  double margin_m = 0.015;  ///< kept free on all sides of the footprint
  double gap_m = 0.13;      ///< where to stand before an obstacle ahead
  BrakingLaw braking{};     ///< deceleration of the base, and the age of an echo when the wheels obey it
  double look_ahead_m = 5;
  double memory_margin_m = -0.03;  ///< instead of margin_m for remembered things, whose place is vague
  double memory_gap_m = 0.08;      ///< instead of gap_m

  void Describe(Archive& a);
};

/// The last filter before the wheels: sweeps the true rectangle along the wanted motion, whatever its
/// direction, and slows it down so that the base can stand `gap_m` before the first point that it would
/// sweep over: v^2 / 2a of braking after the latency. It scales the whole motion, so the base keeps its path.
/// Points beside the swept area do not matter, so both jambs of a door 6 cm beside the base do not stop it.
class CollisionStop {
 public:
  /// What the footprint would meet first.
  struct Nearest {
    double free_m = 0;               ///< driven until then by its fastest point
    Eigen::Vector2d point = {0, 0};  ///< base frame
  };

  /// The limited motion.
  struct Result {
    Twist2 twist;
    double scale = 1;                ///< `twist` over the wanted motion
    std::optional<double> allowed;   ///< fastest motion in this direction [m/s of the fastest corner]
    std::optional<Nearest> nearest;  ///< none within look_ahead_m
  };

  CollisionStop(const CollisionStopConfig& config, const Footprint& footprint);

  /// Speed of the fastest point of the footprint [m/s].
  double SpeedOf(const Twist2& twist) const;
  /// Limits a wanted motion. `seen` and `remembered` are obstacles in the base frame [m].
  Result Limit(const Twist2& wanted, std::span<const Eigen::Vector2d> seen,
               std::span<const Eigen::Vector2d> remembered = {}) const;
  /// The scale for a search among many motions: at most that of Limit. What is farther away than the base
  /// needs for braking is ignored; and because a search ends where a tolerance ends, less and less is
  /// tolerated the more of the margin is used up: it keeps half of the margin.
  double Scale(const Twist2& wanted, std::span<const Eigen::Vector2d> seen,
               std::span<const Eigen::Vector2d> remembered) const;

 private:
  CollisionStopConfig config_;
  Footprint seen_guard_, memory_guard_;  ///< footprint with margin
};

}  // namespace priamos::robot
