#include "world/core/rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace priamos::world {

Rectangle::Rectangle(const Pose2& map_from_rectangle, const Eigen::Vector2d& size_m)
    : centre(map_from_rectangle.translation()),
      axis_x(std::cos(map_from_rectangle.yaw), std::sin(map_from_rectangle.yaw)),
      half(size_m / 2) {}

Eigen::Vector2d Rectangle::ToLocal(const Eigen::Vector2d& in_map) const {
  const Eigen::Vector2d d = in_map - centre;
  return {d.dot(axis_x), d.dot(axis_y())};
}

std::array<Eigen::Vector2d, 4> Rectangle::Corners() const {
  const Eigen::Vector2d x = axis_x * half.x(), y = axis_y() * half.y();
  return {centre + x + y, centre - x + y, centre - x - y, centre + x - y};
}

Rectangle GroundPlan(const Solid& solid) {
  return {solid.map_from_solid, solid.size_m};
}

bool Overlaps(const Solid& solid, double low_m, double high_m) {
  return solid.z_min_m < high_m && solid.z_max_m > low_m;
}

double Distance(const Rectangle& rectangle, const Eigen::Vector2d& point) {
  const Eigen::Vector2d outside = (rectangle.ToLocal(point).cwiseAbs() - rectangle.half).cwiseMax(0);
  return outside.norm();
}

namespace {

/// True when one of a's own axes separates the two (half of the separating axis theorem).
bool Separates(const Rectangle& a, const Rectangle& b) {
  const Eigen::Vector2d d = a.ToLocal(b.centre).cwiseAbs();
  const double c = std::abs(a.axis_x.dot(b.axis_x)), s = std::abs(a.axis_y().dot(b.axis_x));
  const Eigen::Vector2d reach(c * b.half.x() + s * b.half.y(), s * b.half.x() + c * b.half.y());
  return d.x() > a.half.x() + reach.x() || d.y() > a.half.y() + reach.y();
}

}  // namespace

double Distance(const Rectangle& a, const Rectangle& b) {
  if (!Separates(a, b) && !Separates(b, a)) return 0;
  // Between disjoint convex polygons a corner of one is always among the nearest points.
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& corner : a.Corners()) nearest = std::min(nearest, Distance(b, corner));
  for (const auto& corner : b.Corners()) nearest = std::min(nearest, Distance(a, corner));
  return nearest;
}

std::optional<RayHit> CastRay(const Rectangle& rectangle, const Eigen::Vector2d& origin,
                              const Eigen::Vector2d& direction, double max_m) {
  const Eigen::Vector2d o = rectangle.ToLocal(origin);
  const Eigen::Vector2d d(direction.dot(rectangle.axis_x), direction.dot(rectangle.axis_y()));
  double enter = 0, leave = max_m;
  int side = -1;
  for (int i = 0; i < 2; ++i) {
    if (d(i) == 0) {
      if (std::abs(o(i)) > rectangle.half(i)) return std::nullopt;
      continue;
    }
    double near = (-rectangle.half(i) - o(i)) / d(i), far = (rectangle.half(i) - o(i)) / d(i);
    if (near > far) std::swap(near, far);
    if (near > enter) {
      enter = near;
      side = i;
    }
    leave = std::min(leave, far);
    if (enter > leave) return std::nullopt;
  }
  if (side < 0) return std::nullopt;
  const Eigen::Vector2d axis = side == 0 ? rectangle.axis_x : rectangle.axis_y();
  return RayHit{enter, d(side) > 0 ? Eigen::Vector2d(-axis) : axis};
}

}  // namespace priamos::world
