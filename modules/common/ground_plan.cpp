#include "common/ground_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace priamos {

void WallPlan::Describe(Archive& a) {
  a.Text("name", name, "for messages");
  a.Numbers("from_m", from_m, {"m", -100, 100, "map, one end of the centre line: x, y"});
  a.Numbers("to_m", to_m, {"m", -100, 100, "map, the other end of the centre line: x, y"});
  a.Number("thickness_m", thickness_m, {"m", 0.01, 1, "thickness"});
  if (from_m == to_m) a.Refuse("to_m", "an end that differs from from_m");
}

Rectangle WallPlan::Shape() const {
  const Eigen::Vector2d along = to() - from(), middle = (to() + from()) / 2;
  return {{middle.x(), middle.y(), std::atan2(along.y(), along.x())}, {along.norm() / 2, thickness_m / 2}};
}

void DoorPlan::Describe(Archive& a) {
  a.Integer("id", id, {"-", 1, 999, "number of the landmark"});
  a.Text("name", name, "for messages");
  a.Number("x_m", x_m, {"m", -100, 100, "map, middle of the opening, half way through the wall"});
  a.Number("y_m", y_m, {"m", -100, 100, "map, middle of the opening, half way through the wall"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, direction through the opening"});
  a.Number("opening_width_m", opening_width_m, {"m", 0.3, 3, "clear width"});
  a.Number("opening_height_m", opening_height_m, {"m", 1, 3.5, "clear height"});
  a.Number("wall_thickness_m", wall_thickness_m, {"m", 0.05, 1, "thickness of the wall it is in"});
  a.Number("frame_width_m", frame_width_m,
           {"m", 0.01, 0.3, "breadth of the frame's face on the approach side"});
  a.Number("frame_protrusion_m", frame_protrusion_m,
           {"m", 0, 0.1, "how far that face stands before the wall"});
  a.Number("rebate_depth_m", rebate_depth_m, {"m", 0, 0.2, "how deep the leaf sits in the far side"});
  a.Number("rebate_width_m", rebate_width_m, {"m", 0, 0.1, "how much wider the opening is there, each side"});
  if (rebate_depth_m >= wall_thickness_m) a.Refuse("rebate_depth_m", "less than wall_thickness_m");
}

void GroundPlan::Describe(Archive& a) {
  a.List("walls", walls, "straight walls, without the openings");
  a.List("doors", doors, "doors, each in a gap between two walls");
  std::set<int> ids;
  for (const DoorPlan& door : doors)
    if (!ids.insert(door.id).second) a.Refuse("doors", "every door with its own id");
}

const DoorPlan* GroundPlan::FindDoor(int id) const {
  const auto it = std::find_if(doors.begin(), doors.end(), [id](const DoorPlan& d) { return d.id == id; });
  return it == doors.end() ? nullptr : &*it;
}

}  // namespace priamos
