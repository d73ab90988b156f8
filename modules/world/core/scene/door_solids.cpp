#include "world/core/scene/build_solids.hpp"

namespace priamos::world {
namespace {

struct Span {
  double low, high;
  double middle() const { return (low + high) / 2; }
  double length() const { return high - low; }
};

/// A box given by its extent in the door's landmark frame.
Solid BoxIn(const DoorPlan& door, const std::string& part, const Span& x, const Span& y, const Span& z,
            const std::string& material) {
  return {door.name + ": " + part,
          door.map_from_door() * Pose2{x.middle(), y.middle(), 0},
          {x.length(), y.length()},
          z.low,
          z.high,
          material};
}

/// The frame is two steps deep: up to the stop it has the clear width, behind it the rebate for the leaf.
void AddFrame(std::vector<Solid>& solids, const DoorPlan& door) {
  const double half = door.opening_width_m / 2, outer = half + door.frame_width_m;
  const double rebate_half = half + door.rebate_width_m, top = door.opening_height_m + door.frame_width_m;
  const Span front{door.FrontX(), door.StopX()}, back{door.StopX(), door.BackX()};
  const Span height{0, top};
  solids.push_back(BoxIn(door, "left jamb", front, {half, outer}, height, "door_frame"));
  solids.push_back(BoxIn(door, "right jamb", front, {-outer, -half}, height, "door_frame"));
  solids.push_back(BoxIn(door, "lintel", front, {-half, half}, {door.opening_height_m, top}, "door_frame"));
  if (door.rebate_depth_m <= 0) return;
  solids.push_back(BoxIn(door, "left rebate", back, {rebate_half, outer}, height, "door_frame"));
  solids.push_back(BoxIn(door, "right rebate", back, {-outer, -rebate_half}, height, "door_frame"));
  solids.push_back(BoxIn(door, "upper rebate", back, {-rebate_half, rebate_half},
                         {door.opening_height_m + door.rebate_width_m, top}, "door_frame"));
}

Solid Leaf(const DoorPlan& door, const DoorWork& work, double open_deg) {
  const LeafShape leaf = LeafOf(door, work.hinge, open_deg, work.leaf_thickness_m);
  return {LeafName(door), door.map_from_door() * leaf.door_from_leaf, leaf.size_m, leaf.z_min_m, leaf.z_max_m,
          "door_leaf"};
}

}  // namespace

std::string LeafName(const DoorPlan& door) {
  return door.name + ": leaf";
}

std::vector<Solid> DoorSolids(const DoorPlan& built, const DoorWork& work, double open_deg) {
  std::vector<Solid> solids;
  AddFrame(solids, built);
  solids.push_back(Leaf(built, work, open_deg));
  if (work.threshold_m > 0) {
    const double half = built.opening_width_m / 2;
    solids.push_back(BoxIn(built, "threshold", {built.FrontX(), built.BackX()}, {-half, half},
                           {0, work.threshold_m}, "metal"));
  }
  return solids;
}

}  // namespace priamos::world
