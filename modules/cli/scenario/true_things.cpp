#include "cli/scenario/true_things.hpp"

#include <algorithm>

namespace priamos::cli {
namespace {

constexpr double kSurface_m = 0.02;
/// Plan and world give the same wall but for rounding.
constexpr double kSame_m = 1e-3;

Rectangle ShapeOf(const world::Solid& solid) {
  return {solid.map_from_solid, solid.size_m / 2};
}

bool IsInside(const Rectangle& inner, const Rectangle& outer) {
  const auto corners = inner.Corners();
  return std::all_of(corners.begin(), corners.end(),
                     [&](const auto& corner) { return Distance(outer, corner) < kSame_m; });
}

/// Label of a thing: its name without the door that it belongs to ("leaf" of "laboratory: leaf"), which the
/// plan shows.
std::string ShortName(const std::string& name) {
  const auto colon = name.find(": ");
  return colon == std::string::npos ? name : name.substr(colon + 2);
}

}  // namespace

std::vector<Rectangle> WallShapes(const GroundPlan& plan) {
  std::vector<Rectangle> shapes;
  for (const WallPlan& wall : plan.walls) shapes.push_back(wall.Shape());
  return shapes;
}

std::vector<Rectangle> FrameShapes(const DoorPlan& door) {
  const double half = door.opening_width_m / 2, outer = half + door.frame_width_m;
  const auto box = [&](double x0, double x1, double y0, double y1, double side) {
    return Rectangle{door.map_from_door() * Pose2{(x0 + x1) / 2, side * (y0 + y1) / 2, 0},
                     {(x1 - x0) / 2, (y1 - y0) / 2}};
  };
  std::vector<Rectangle> shapes;
  for (const double side : {1.0, -1.0}) {
    shapes.push_back(box(door.FrontX(), door.StopX(), half, outer, side));
    shapes.push_back(box(door.StopX(), door.BackX(), half + door.rebate_width_m, outer, side));
  }
  return shapes;
}

std::vector<TrueThing> ThingsBeyond(const GroundPlan& plan, const TrueWorld& world) {
  std::vector<Rectangle> known = WallShapes(plan);
  for (const DoorPlan& door : plan.doors) {
    const auto frame = FrameShapes(door);
    known.insert(known.end(), frame.begin(), frame.end());
  }
  std::vector<TrueThing> things;
  for (const world::Solid& solid : world.solids) {
    const Rectangle shape = ShapeOf(solid);
    if (solid.z_max_m <= world.body.low_m || solid.z_min_m >= world.body.high_m) continue;
    if (solid.size_m.minCoeff() <= kSurface_m) continue;
    if (std::any_of(known.begin(), known.end(), [&](const auto& k) { return IsInside(shape, k); })) continue;
    const auto corners = shape.Corners();
    things.push_back({ShortName(solid.name), {corners.begin(), corners.end()}});
  }
  return things;
}

}  // namespace priamos::cli
