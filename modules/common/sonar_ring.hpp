#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace priamos {

/// Sensors of the sonar ring, and between which distances [m] each measures.
inline constexpr int kSonars = 24;
inline constexpr double kSonarMin_m = 0.1, kSonarMax_m = 5;

/// Pose of a sonar in the base frame, base_from_sonar, of sensor `index` (0 is S1) on the edge of a footprint
/// of `footprint_m` (length, width): S1 looks straight ahead, the others follow every 15 degrees
/// counter-clockwise, each where the ray from the base centre leaves the rectangle.
Pose2 BaseFromSonar(int index, const Eigen::Vector2d& footprint_m);

}  // namespace priamos
