#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/input/section_place.hpp"

namespace priamos::world {

/// A pit, a flight of steps down, an edge: a rectangle along the axes of the map where the floor is lower.
struct HolePlan {
  std::string name = "hole";
  double x_m = 0, y_m = 0;           ///< map, middle
  double length_m = 1, width_m = 1;  ///< along x and y of the map
  double depth_m = 0.2;
  SectionPlace place;  ///< where it was read, for errors

  void Describe(Archive& a);
  bool Contains(const Eigen::Vector2d& in_map) const;
};

/// The hole below a point; none where the floor is.
const HolePlan* HoleAt(const std::vector<HolePlan>& holes, const Eigen::Vector2d& in_map);

/// Where a ray meets the floor, the bottom of a hole or a side of it.
struct FloorHit {
  double distance_m;
  Eigen::Vector3d normal;  ///< towards the ray's origin
  int hole = -1;           ///< place in the list; -1: the floor itself
};

/// First of them along a unit vector; none for a ray that meets none.
std::optional<FloorHit> CastToFloor(const std::vector<HolePlan>& holes, const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& direction);

/// A rectangle along the axes of the map.
struct FloorPiece {
  Eigen::Vector2d low, high;
};

/// The floor between `low` and `high` without its holes.
std::vector<FloorPiece> FloorAround(const std::vector<HolePlan>& holes, const FloorPiece& floor);

}  // namespace priamos::world
