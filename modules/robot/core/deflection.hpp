#pragma once

#include <Eigen/Core>
#include <span>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "robot/core/footprint.hpp"

namespace priamos::robot {

struct DeflectionConfig {
  double gap_m = 0.06;  ///< nearer than this nothing is approached
  double braking_m_s2 = 0.6;
  double latency_s = 0.2;
  double reach_m = 1.0;  ///< points farther away do not deflect

  void Describe(Archive& a);
};

/// The part of an operator's wish that leads nowhere into an obstacle: each near point limits the velocity
/// with which the part of the footprint that is nearest to it may approach, by braking distance; the nearest
/// motion to `wanted` within all limits is found by projection. So pushing into a wall at a slant slides
/// along it, and pushing straight into it stops. A point beside a corner may be passed on either side of it.
/// Motion away is never limited, and nothing is turned round or invented. The collision stop still comes
/// after it.
Twist2 Deflected(const DeflectionConfig& config, const Footprint& footprint, const Twist2& wanted,
                 std::span<const Eigen::Vector2d> points);

}  // namespace priamos::robot
