#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "common/geometry.hpp"
#include "world/core/solid.hpp"

namespace priamos::world {

/// A rectangle on the floor: the ground plan of a solid, or the robot's footprint [m, map].
struct Rectangle {
  Eigen::Vector2d centre{0, 0};
  Eigen::Vector2d axis_x{1, 0};  ///< unit vector of its own x axis
  Eigen::Vector2d half{0, 0};    ///< half lengths along its own axes

  Rectangle() = default;
  Rectangle(const Pose2& map_from_rectangle, const Eigen::Vector2d& size_m);

  Eigen::Vector2d axis_y() const { return {-axis_x.y(), axis_x.x()}; }
  Eigen::Vector2d ToLocal(const Eigen::Vector2d& in_map) const;
  /// Counter-clockwise.
  std::array<Eigen::Vector2d, 4> Corners() const;
  /// Radius of the circle around it.
  double Radius() const { return half.norm(); }
};

Rectangle GroundPlan(const Solid& solid);

/// True when the solid occupies any height within (low, high) [m].
bool Overlaps(const Solid& solid, double low_m, double high_m);

/// Exact distance between a point and a rectangle [m]; 0 inside.
double Distance(const Rectangle& rectangle, const Eigen::Vector2d& point);
/// Exact distance between two rectangles [m]; 0 when they touch or overlap.
double Distance(const Rectangle& a, const Rectangle& b);

/// Where a ray meets a rectangle from outside.
struct RayHit {
  double distance_m = 0;
  Eigen::Vector2d normal{0, 0};  ///< outward unit normal of the side that was hit
};

/// First intersection within `max_m`; nothing when the ray starts inside or on the rectangle. `direction` is
/// a unit vector.
std::optional<RayHit> CastRay(const Rectangle& rectangle, const Eigen::Vector2d& origin,
                              const Eigen::Vector2d& direction, double max_m);

}  // namespace priamos::world
