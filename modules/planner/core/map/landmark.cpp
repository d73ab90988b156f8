#include "planner/core/map/landmark.hpp"

#include <cmath>

namespace priamos::planner {

bool IsVisible(const LandmarkEdge& edge, const Eigen::Vector2d& in_landmark) {
  const auto turn_from_begin = [&edge](double rad) {
    const double turn = std::fmod(rad - edge.visible_from_rad, 2 * kPi);
    return turn < 0 ? turn + 2 * kPi : turn;
  };
  if (edge.visible_to_rad - edge.visible_from_rad > 2 * kPi - 0.02) return true;
  const double azimuth = std::atan2(in_landmark.y(), in_landmark.x());
  return turn_from_begin(azimuth) <= turn_from_begin(edge.visible_to_rad);
}

}  // namespace priamos::planner
