#include "common/rectangle.hpp"

#include <algorithm>
#include <limits>

namespace priamos {
namespace {

/// Whether a line parallel to a side of `a` lies between the two: the separating axis theorem for a's axes.
bool SideSeparates(const Rectangle& a, const std::array<Eigen::Vector2d, 4>& b) {
  Eigen::Vector2d low = a.ToLocal(b[0]), high = low;
  for (const auto& corner : b) {
    low = low.cwiseMin(a.ToLocal(corner));
    high = high.cwiseMax(a.ToLocal(corner));
  }
  return (low.array() > a.half_m.array()).any() || (high.array() < -a.half_m.array()).any();
}

}  // namespace

Eigen::Vector2d Rectangle::ToLocal(const Eigen::Vector2d& in_map) const {
  return map_from_centre.rotation().transpose() * (in_map - map_from_centre.translation());
}

std::array<Eigen::Vector2d, 4> Rectangle::Corners() const {
  const double x = half_m.x(), y = half_m.y();
  return {map_from_centre * Eigen::Vector2d(x, y), map_from_centre * Eigen::Vector2d(-x, y),
          map_from_centre * Eigen::Vector2d(-x, -y), map_from_centre * Eigen::Vector2d(x, -y)};
}

Eigen::Vector2d Rectangle::NearestTo(const Eigen::Vector2d& in_map) const {
  return map_from_centre * ToLocal(in_map).cwiseMax(-half_m).cwiseMin(half_m).eval();
}

double Distance(const Rectangle& rectangle, const Eigen::Vector2d& in_map) {
  return (rectangle.ToLocal(in_map).cwiseAbs() - rectangle.half_m).cwiseMax(0).norm();
}

double Distance(const Rectangle& a, const Rectangle& b) {
  const auto corners_a = a.Corners(), corners_b = b.Corners();
  if (!SideSeparates(a, corners_b) && !SideSeparates(b, corners_a)) return 0;
  // Between disjoint convex polygons a corner of one of them is always among the nearest points.
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& corner : corners_a) nearest = std::min(nearest, Distance(b, corner));
  for (const auto& corner : corners_b) nearest = std::min(nearest, Distance(a, corner));
  return nearest;
}

}  // namespace priamos
