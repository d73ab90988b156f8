#include "world/core/scene/outline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::world {

Rectangle OutlineOf(const Solid& solid) {
  return {solid.map_from_solid, solid.size_m / 2};
}

bool Overlaps(const Solid& solid, double low_m, double high_m) {
  return solid.z_min_m < high_m && solid.z_max_m > low_m;
}

RayTarget::RayTarget(const Rectangle& outline)
    : centre(outline.map_from_centre.translation()),
      axis_x(outline.map_from_centre.rotation().col(0)),
      half(outline.half_m) {}

std::optional<OutlineHit> CastRay(const RayTarget& target, const Eigen::Vector2d& origin,
                                  const Eigen::Vector2d& direction, double max_m) {
  const Eigen::Vector2d axis_y(-target.axis_x.y(), target.axis_x.x()), from_centre = origin - target.centre;
  const Eigen::Vector2d o(from_centre.dot(target.axis_x), from_centre.dot(axis_y));
  const Eigen::Vector2d d(direction.dot(target.axis_x), direction.dot(axis_y));
  double enter = 0, leave = max_m;
  int side = -1;
  for (int i = 0; i < 2; ++i) {
    if (d(i) == 0) {
      if (std::abs(o(i)) > target.half(i)) return std::nullopt;
      continue;
    }
    double near = (-target.half(i) - o(i)) / d(i), far = (target.half(i) - o(i)) / d(i);
    if (near > far) std::swap(near, far);
    if (near > enter) {
      enter = near;
      side = i;
    }
    leave = std::min(leave, far);
    if (enter > leave) return std::nullopt;
  }
  if (side < 0) return std::nullopt;
  const Eigen::Vector2d axis = side == 0 ? target.axis_x : axis_y;
  return OutlineHit{enter, d(side) > 0 ? Eigen::Vector2d(-axis) : axis};
}

}  // namespace priamos::world
