#include "planner/core/map/door_landmark.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "planner/core/map/box_skeleton.hpp"
#include "planner/core/map/door_sides.hpp"

namespace priamos::planner {
namespace {

/// From where a door is looked at; sectors of edges in the depth of the wall are exact for this distance.
constexpr double kViewingDistance_m = 2.5;
/// How far inside the line of a jamb a viewer must stand for its depth to be seen as two separate edges: at
/// the viewing distance the two arrises of a 12 cm deep jamb are then about 4 of 768 pixels apart.
constexpr double kJambView_m = 0.2;
/// Faces seen under a flatter angle than this give no usable edge.
constexpr double kGrazing_rad = Radians(15);

struct Sector {
  double from_rad, to_rad;
};

/// Everybody before the wall.
constexpr Sector kApproachSide{kPi / 2 + kGrazing_rad, -kPi / 2 - kGrazing_rad};

/// Viewers who see the depth of the left jamb: not from behind its face, not through the right jamb.
Sector LeftJambSector(const DoorPlan& door) {
  const double half_m = door.opening_width_m / 2;
  const double behind_face = std::atan2(half_m - kJambView_m, kViewingDistance_m);
  const double past_right_jamb = std::atan2(door.opening_width_m, door.StopX() - door.FrontX());
  return {WrapAngle(kPi - behind_face), WrapAngle(kPi + past_right_jamb - kGrazing_rad)};
}

/// Adds an upright edge at y and its mirror image at -y [m]; the sector is mirrored with it. `grey_ratio`: of
/// what is nearer to the opening over what is farther from it, which is right of the left edge.
void AddJambEdge(std::vector<LandmarkEdge>& edges, double x, double y, double height, const Sector& sector,
                 std::optional<double> grey_ratio = {}) {
  const auto mirrored = grey_ratio ? std::optional(-*grey_ratio) : std::nullopt;
  edges.push_back({{x, y, 0}, {x, y, height}, sector.from_rad, sector.to_rad, Side::kLeft, grey_ratio});
  edges.push_back({{x, -y, 0}, {x, -y, height}, -sector.to_rad, -sector.from_rad, Side::kRight, mirrored});
}

/// It runs to the left: what is nearer to the opening is left of it.
void AddLintelEdge(std::vector<LandmarkEdge>& edges, double x, double half_width, double z,
                   std::optional<double> grey_ratio = {}) {
  edges.push_back({{x, -half_width, z},
                   {x, half_width, z},
                   kApproachSide.from_rad,
                   kApproachSide.to_rad,
                   Side::kBoth,
                   grey_ratio ? std::optional(-*grey_ratio) : std::nullopt});
}

/// Grey ratio of frame over wall, where the map notes it.
std::optional<double> FrameOverWall(const DoorPlan& door) {
  return door.frame_over_wall > 0 ? std::optional(std::log(door.frame_over_wall)) : std::nullopt;
}

/// Viewers who see the left stop past the arris of its own rebate.
Sector LeftStopSector(const DoorPlan& door) {
  if (door.rebate_depth_m <= 0) return kApproachSide;
  return {kPi - std::atan2(door.rebate_width_m, door.rebate_depth_m), kApproachSide.to_rad};
}

/// Frame and wall as what hides the leaf, and the leaf itself.
std::array<LandmarkBox, 7> BoxesOf(const DoorPlan& door) {
  constexpr double kWall_m = 6, kCeiling_m = 4;
  const double half = door.opening_width_m / 2, outer = half + door.frame_width_m;
  const double top = door.opening_height_m, depth = door.StopX() - door.FrontX();
  const double middle = (door.StopX() + door.FrontX()) / 2;
  const auto hiding = [](double x, double y, double dx, double dy, double low, double high) {
    return LandmarkBox{{x, y, 0}, {dx, dy}, low, high, false, Side::kBoth};
  };
  const LeafShape leaf = LeafOf(door, door.leaf, door.leaf_open_deg, door.leaf_thickness_m);
  const double wall = half + kWall_m / 2, beyond = outer + kWall_m / 2;
  return {hiding(middle, wall, depth, kWall_m, 0, kCeiling_m),
          hiding(middle, -wall, depth, kWall_m, 0, kCeiling_m),
          hiding(middle, 0, depth, 2 * half, top, kCeiling_m),
          hiding(0, beyond, door.wall_thickness_m, kWall_m, 0, kCeiling_m),
          hiding(0, -beyond, door.wall_thickness_m, kWall_m, 0, kCeiling_m),
          hiding(0, 0, door.wall_thickness_m, 2 * outer, top + door.rebate_width_m, kCeiling_m),
          {leaf.door_from_leaf, leaf.size_m, leaf.z_min_m, leaf.z_max_m, true, Side::kMovable}};
}

/// The leaf's edges that the approach side sees, the longest ones first, as many as there is room for.
void AddLeaf(const DoorPlan& door, std::vector<LandmarkEdge>& edges) {
  if (door.leaf != "left" && door.leaf != "right") return;
  const auto boxes = BoxesOf(door);
  Viewers viewers;
  viewers.from_rad = kApproachSide.from_rad;
  viewers.to_rad = kApproachSide.to_rad;
  std::vector<LandmarkEdge> leaf = SkeletonOf(boxes, viewers);
  std::stable_sort(leaf.begin(), leaf.end(), [](const LandmarkEdge& a, const LandmarkEdge& b) {
    return (a.to - a.from).norm() > (b.to - b.from).norm();
  });
  for (const LandmarkEdge& edge : leaf)
    if (edges.size() < std::size_t(kMaxLandmarkEdges)) edges.push_back(edge);
}

}  // namespace

Landmark MakeDoorLandmark(const DoorPlan& door) {
  const double half = door.opening_width_m / 2, outer = half + door.frame_width_m;
  const double top = door.opening_height_m, outer_top = top + door.frame_width_m;
  Landmark landmark{door.id, door.map_from_door(), {}};
  auto& edges = landmark.edges;
  AddJambEdge(edges, door.FrontX(), outer, outer_top, kApproachSide, FrameOverWall(door));
  AddJambEdge(edges, door.FrontX(), half, top, kApproachSide);
  AddJambEdge(edges, door.StopX(), half, top, LeftJambSector(door));
  AddLintelEdge(edges, door.FrontX(), outer, outer_top, FrameOverWall(door));
  AddLintelEdge(edges, door.FrontX(), half, top);
  AddLintelEdge(edges, door.StopX(), half, top);
  AddLeaf(door, edges);
  return landmark;
}

Landmark MakeDoorLandmarkFromBehind(const DoorPlan& door) {
  const DoorPlan seen = FromBehind(door);
  const double half = seen.opening_width_m / 2, outer = half + seen.frame_width_m;
  const double top = seen.opening_height_m, outer_top = top + seen.frame_width_m;
  const double near = -door.BackX(), stop = -door.StopX(), far = -door.FrontX();
  Landmark landmark{seen.id, seen.map_from_door(), {}};
  auto& edges = landmark.edges;
  AddJambEdge(edges, near, outer, outer_top, kApproachSide, FrameOverWall(door));
  AddJambEdge(edges, stop, half, top, LeftStopSector(door));
  AddJambEdge(edges, far, half, top, LeftJambSector(door));
  AddLintelEdge(edges, near, outer, outer_top, FrameOverWall(door));
  AddLintelEdge(edges, stop, half, top);
  AddLintelEdge(edges, far, half, top);
  return landmark;
}

}  // namespace priamos::planner
