#pragma once

#include "common/rectangle.hpp"
#include "world/core/scene/leaf_swing.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// A door's leaf that is moved by the clock. It stops where it would touch the robot, and goes on when the
/// robot has left; the last swing that has begun counts.
class SwingingLeaf {
 public:
  /// Leaf that stands as `solid` does.
  SwingingLeaf(MovedLeaf leaf, const Solid& solid);

  /// Advances by `dt_s` to `since_start_s`.
  void Step(double since_start_s, double dt_s, const Rectangle& robot);
  Pose2 map_from_leaf() const { return PoseAt(open_deg_); }
  double open_deg() const { return open_deg_; }

 private:
  Pose2 PoseAt(double open_deg) const;

  MovedLeaf leaf_;
  Eigen::Vector2d half_m_;
  double open_deg_;
};

}  // namespace priamos::world
