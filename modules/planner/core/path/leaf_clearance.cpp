#include "planner/core/path/leaf_clearance.hpp"

#include <algorithm>

namespace priamos::planner {

double FreeWidth(const DoorPlan& door, const std::string& hinge, double open_rad) {
  const LeafShape leaf = LeafOf(door, hinge, Degrees(open_rad), door.leaf_thickness_m);
  const double side = hinge == "left" ? 1 : -1;
  double free_m = door.opening_width_m;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector2d corner =
          leaf.door_from_leaf * Eigen::Vector2d(x * leaf.size_m.x(), y * leaf.size_m.y());
      free_m = std::min(free_m, side * corner.y() + door.opening_width_m / 2);
    }
  }
  return std::max(free_m, 0.0);
}

}  // namespace priamos::planner
