#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/rectangle.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// The solid's ground plan.
Rectangle OutlineOf(const Solid& solid);

/// True when the solid occupies any height within (low, high) [m].
bool Overlaps(const Solid& solid, double low_m, double high_m);

/// An outline prepared for many rays.
struct RayTarget {
  explicit RayTarget(const Rectangle& outline);

  Eigen::Vector2d centre;
  Eigen::Vector2d axis_x;  ///< unit vector of the rectangle's x axis
  Eigen::Vector2d half;
};

/// Where a ray meets an outline from outside.
struct OutlineHit {
  double distance_m = 0;
  Eigen::Vector2d normal{0, 0};  ///< outward unit normal of the side that was hit
};

/// First intersection within `max_m`; nothing when the ray starts inside or on the outline. `direction` is a
/// unit vector.
std::optional<OutlineHit> CastRay(const RayTarget& target, const Eigen::Vector2d& origin,
                                  const Eigen::Vector2d& direction, double max_m);

}  // namespace priamos::world
