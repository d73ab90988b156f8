#pragma once

#include "cli/scenario/true_world.hpp"
#include "common/geometry.hpp"

namespace priamos::cli {

/// What a robot that knew the world exactly could do with an operator's wish. It is the measure of a drive by
/// hand and no part of one: it uses the exact rectangles of the world, not echoes. It shares the form of the
/// braking law with the robot; the report also gives it the robot's limit of acceleration.
///
/// The margin: 6 cm are kept free beside the path, and the base comes to stand 20 cm before what it would
/// touch, braking with 1 m/s^2 after 0.2 s. The robot itself means to keep 5.5 and 18.5 cm.
class FreeMotion {
 public:
  explicit FreeMotion(const TrueWorld& world);

  /// The motion that comes farthest along `wish`, of all whose components lie between 0 and those of `wish`.
  Twist2 Of(const Pose2& map_from_base, const Twist2& wish) const;
  /// Speed of `motion` along `wish` [m/s of the fastest corner]: turning counts with the lever of a
  /// corner.
  double Along(const Twist2& wish, const Twist2& motion) const;

 private:
  double SpeedOf(const Twist2& motion) const;
  double Scale(const Pose2& map_from_base, const Twist2& motion) const;
  double FreeDistance(const Pose2& map_from_base, const Twist2& per_metre, double farthest) const;

  double lever_m_;
  world::Clearance bare_, guarded_;  ///< free space around the footprint, and around it with the margin
};

}  // namespace priamos::cli
