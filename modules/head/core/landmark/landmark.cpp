#include "head/core/landmark/landmark.hpp"

#include <algorithm>

namespace priamos::head {
namespace {

/// Angle `rad` as a turn counter-clockwise in [0, 2 pi).
double Turn(double rad) {
  const double turn = std::fmod(rad, 2 * kPi);
  return turn < 0 ? turn + 2 * kPi : turn;
}

}  // namespace

bool LandmarkEdge::IsSeenFrom(const Eigen::Vector2d& in_landmark, double margin_rad) const {
  const double width = visible_to_rad - visible_from_rad;
  if (width >= 2 * kPi - 0.02) return true;
  const double begin = visible_from_rad - margin_rad;
  const double azimuth = std::atan2(in_landmark.y(), in_landmark.x());
  return Turn(azimuth - begin) <= std::min(Turn(width) + 2 * margin_rad, 2 * kPi);
}

}  // namespace priamos::head
