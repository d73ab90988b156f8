#include "common/ground_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace priamos {
namespace {

/// Swing-clear hinges: the pin stands this far out of the far face of the frame and beside the leaf, so that
/// a leaf that is open by 90 degrees or more leaves the whole opening free.
constexpr double kPinOut_m = 0.01;
constexpr double kPinClearance_m = 0.005;
/// Gap between leaf and frame all around, and under the leaf.
constexpr double kLeafPlay_m = 0.003;
constexpr double kLeafLow_m = 0.01;
/// No two surfaces of a room differ by more.
constexpr double kMostTimesAsBright = 20;

}  // namespace

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
  a.Integer("id", id, {"-", kFirstLandmarkId, kLastLandmarkId, "number of the landmark"});
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
  a.Text("leaf", leaf, "hinges of the leaf, left or right, if its angle is known; none; or unknown");
  a.Number("leaf_open_deg", leaf_open_deg, {"deg", 0, 175, "angle of the leaf, 0 is closed"});
  a.Number("leaf_thickness_m", leaf_thickness_m, {"m", 0.01, 0.1, "thickness of the leaf"});
  a.Number("frame_over_wall", frame_over_wall,
           {"-", 0, kMostTimesAsBright, "how many times as bright the frame is as the wall; 0: not known"});
  a.Integer("behind_id", behind_id,
            {"-", 0, kLastLandmarkId, "number of its landmark from behind; 0: passed from the front only"});
  if (rebate_depth_m >= wall_thickness_m) a.Refuse("rebate_depth_m", "less than wall_thickness_m");
  if (leaf != "left" && leaf != "right" && leaf != "none" && leaf != "unknown")
    a.Refuse("leaf", "left, right, none or unknown");
}

LeafShape LeafOf(const DoorPlan& door, const std::string& hinge, double open_deg, double thickness_m) {
  const double side = hinge == "left" ? 1 : -1;
  const double leaf_half = door.opening_width_m / 2 + door.rebate_width_m - kLeafPlay_m;
  const double pin_depth = door.BackX() + kPinOut_m - door.StopX();
  const double pin_y = side * (door.opening_width_m / 2 + pin_depth + kPinClearance_m);
  const Pose2 door_from_pin{door.BackX() + kPinOut_m, pin_y, side * Radians(open_deg)};
  const Pose2 pin_from_leaf{-pin_depth + thickness_m / 2, -pin_y, 0};
  return {door_from_pin * pin_from_leaf,
          {thickness_m, 2 * leaf_half},
          kLeafLow_m,
          door.opening_height_m + door.rebate_width_m - kLeafPlay_m};
}

void CupboardPlan::Describe(Archive& a) {
  a.Integer("id", id, {"-", kFirstLandmarkId, kLastLandmarkId, "number of the landmark"});
  a.Text("name", name, "for messages");
  a.Number("x_m", x_m, {"m", -100, 100, "map, middle of its front"});
  a.Number("y_m", y_m, {"m", -100, 100, "map, middle of its front"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, direction into it"});
  a.Number("width_m", width_m, {"m", 0.2, 5, "breadth of its front"});
  a.Number("depth_m", depth_m, {"m", 0.1, 2.4, "from front to back"});
  a.Number("height_m", height_m, {"m", 0.2, 4, "height"});
  a.Integer("n_doors", n_doors, {"-", 1, 5, "doors side by side"});
  a.Number("gap_m", gap_m, {"m", 0, 0.1, "between two doors"});
  a.Number("plinth_m", plinth_m, {"m", 0, 0.5, "height of the plinth under the doors"});
  a.Number("plinth_over_front", plinth_over_front,
           {"-", 0, kMostTimesAsBright, "how many times as bright the plinth is as the doors; 0: not known"});
  if (plinth_m >= height_m) a.Refuse("plinth_m", "less than height_m");
}

void NoGoPlan::Describe(Archive& a) {
  a.Text("name", name, "for messages");
  a.Number("x_m", x_m, {"m", -100, 100, "map, its middle"});
  a.Number("y_m", y_m, {"m", -100, 100, "map, its middle"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, direction of its length"});
  a.Number("length_m", length_m, {"m", 0.05, 200, "its length"});
  a.Number("width_m", width_m, {"m", 0.05, 200, "its width"});
}

void GroundPlan::Describe(Archive& a) {
  a.Number("wall_sigma_m", wall_sigma_m,
           {"m", 0.005, 0.32, "how well the ends of walls are known, across them, one sigma"});
  a.List("walls", walls, "straight walls, without the openings");
  a.List("doors", doors, "doors, each in a gap between two walls");
  a.List("cupboards", cupboards, "cupboards that serve as landmarks");
  a.List("no_go", no_go, "areas of the floor that no path leads over");
  std::set<int> ids;
  for (const DoorPlan& door : doors)
    if (!ids.insert(door.id).second || (door.behind_id != 0 && !ids.insert(door.behind_id).second))
      a.Refuse("doors", "every door with its own id, and its own behind_id");
  for (const CupboardPlan& cupboard : cupboards)
    if (!ids.insert(cupboard.id).second) a.Refuse("cupboards", "every landmark with its own id");
}

const DoorPlan* GroundPlan::FindDoor(int id) const {
  const auto it = std::find_if(doors.begin(), doors.end(), [id](const DoorPlan& d) { return d.id == id; });
  return it == doors.end() ? nullptr : &*it;
}

}  // namespace priamos
