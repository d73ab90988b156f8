#include "world/core/generate/sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr double kThickness_m = 0.14;
constexpr double kBeside_m = 0.03, kAlong_m = 0.10, kTape_m = 0.005, kNarrower_m = 0.02;
/// Shorter pieces of a wall are part of a door's frame.
constexpr double kShortest_m = 0.02;

struct Line {
  explicit Line(const SketchWall& wall)
      : length_m((wall.to - wall.from).norm()), along((wall.to - wall.from) / length_m) {}
  double length_m;
  Eigen::Vector2d along;
};

void AddPiece(const SketchWall& wall, double begin_m, double end_m, GroundPlan& plan) {
  if (end_m - begin_m < kShortest_m) return;
  const Eigen::Vector2d along = Line(wall).along, from = wall.from + begin_m * along,
                        to = wall.from + end_m * along;
  const auto pieces = std::count_if(plan.walls.begin(), plan.walls.end(), [&](const WallPlan& other) {
    return other.name == wall.name || other.name.starts_with(wall.name + " ");
  });
  const std::string name = pieces == 0 ? wall.name : fmt::format("{} {}", wall.name, pieces + 1);
  plan.walls.push_back({name, {from.x(), from.y()}, {to.x(), to.y()}, kThickness_m});
}

DoorPlan PlacedDoor(const SketchWall& wall, const SketchDoor& sketched) {
  const Line line(wall);
  const Eigen::Vector2d at = wall.from + sketched.along_m * line.along;
  const double turn = sketched.to_left ? kPi / 2 : -kPi / 2;
  DoorPlan door = sketched.door;
  door.x_m = at.x();
  door.y_m = at.y();
  door.yaw_deg = Degrees(WrapAngle(std::atan2(line.along.y(), line.along.x()) + turn));
  door.wall_thickness_m = kThickness_m;
  return door;
}

}  // namespace

GroundPlan PlanOf(const Sketch& sketch) {
  GroundPlan plan;
  for (SketchWall wall : sketch.walls) {
    std::sort(wall.doors.begin(), wall.doors.end(),
              [](const SketchDoor& a, const SketchDoor& b) { return a.along_m < b.along_m; });
    double begin_m = 0;
    for (const SketchDoor& door : wall.doors) {
      AddPiece(wall, begin_m, door.along_m - door.door.opening_width_m / 2, plan);
      begin_m = door.along_m + door.door.opening_width_m / 2;
      plan.doors.push_back(PlacedDoor(wall, door));
    }
    AddPiece(wall, begin_m, Line(wall).length_m, plan);
  }
  return plan;
}

Sketch Surveyed(Sketch sketch, Rng& rng) {
  const auto within = [&rng](double bound) { return rng.Uniform(-1, 1) * bound; };
  for (SketchWall& wall : sketch.walls) {
    const Eigen::Vector2d along = Line(wall).along, across(-along.y(), along.x());
    wall.from += within(kBeside_m) * across;
    wall.to += within(kBeside_m) * across;
    for (SketchDoor& door : wall.doors) {
      door.along_m += within(kAlong_m);
      door.door.opening_width_m += rng.Normal(kTape_m) + rng.Uniform(0, kNarrower_m);
      for (double* size : {&door.door.opening_height_m, &door.door.frame_width_m})
        *size += rng.Normal(kTape_m);
      door.door.frame_protrusion_m = std::max(0.003, door.door.frame_protrusion_m + rng.Normal(kTape_m));
      door.door.frame_width_m = std::max(0.01, door.door.frame_width_m);
    }
  }
  return sketch;
}

}  // namespace priamos::world
