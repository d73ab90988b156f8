#include "common/sonar_ring.hpp"

#include <algorithm>
#include <cmath>

namespace priamos {

Pose2 BaseFromSonar(int index, const Eigen::Vector2d& footprint_m) {
  const double bearing = 2 * kPi * index / kSonars;
  const double c = std::cos(bearing), s = std::sin(bearing);
  const Eigen::Vector2d half = footprint_m / 2;
  const double to_side =
      std::min(half.x() / std::max(std::abs(c), 1e-12), half.y() / std::max(std::abs(s), 1e-12));
  return {to_side * c, to_side * s, WrapAngle(bearing)};
}

}  // namespace priamos
