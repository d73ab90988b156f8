#include "robot/core/base/footprint.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {

void Footprint::Describe(Archive& a) {
  a.Number("length_m", length_m, {"m", 0.1, 3, "along x, over everything that can touch"});
  a.Number("width_m", width_m, {"m", 0.1, 3, "along y, over everything that can touch"});
}

double Footprint::Distance(const Eigen::Vector2d& point) const {
  const double dx = std::abs(point.x()) - length_m / 2, dy = std::abs(point.y()) - width_m / 2;
  return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0);
}

Eigen::Vector2d Footprint::Nearest(const Eigen::Vector2d& point) const {
  return {std::clamp(point.x(), -length_m / 2, length_m / 2),
          std::clamp(point.y(), -width_m / 2, width_m / 2)};
}

double Footprint::Reach() const {
  return std::hypot(length_m, width_m) / 2;
}

}  // namespace priamos::robot
