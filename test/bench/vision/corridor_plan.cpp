#include "test/bench/vision/corridor_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace priamos::bench {
namespace {

constexpr double kRoomDepth_m = 3;  // behind the doors
constexpr const char* kWalls[] = {"left", "right", "end"};

template <typename T, std::size_t N>
T OneOf(const std::array<T, N>& choices, Rng& rng) {
  return choices[rng.Below(N)];
}

/// One wall of the corridor with its face towards the corridor.
struct Side {
  int number = 0;               ///< in kWalls
  Eigen::Vector2d from;         ///< of its centre line
  Eigen::Vector2d along, into;  ///< unit vectors: along the wall, and out of the corridor
  double length_m = 0, thickness_m = 0;

  Eigen::Vector2d At(double s, double depth) const { return from + s * along + depth * into; }
  double YawThrough() const { return std::atan2(into.y(), into.x()); }
};

class Draughtsman {
 public:
  explicit Draughtsman(std::uint64_t seed) : rng_(Rng::Stream(seed, "corridor")) {}

  CorridorPlan Draw(std::uint64_t seed) {
    plan_.length_m = rng_.Uniform(10, 14);
    plan_.width_m = rng_.Uniform(1.8, 3.4);
    DrawSurfaces();
    for (const Side& side : Sides()) {
      AddWall(kWalls[side.number], side.At(0, 0), side.At(side.length_m, 0), side.thickness_m);
      if (side.number < 2)
        Furnish(side);
      else if (rng_.Chance(0.7))
        AddDoor(side, side.length_m / 2 + rng_.Uniform(-0.2, 0.2));
    }
    AddRooms();
    plan_.light = world::DrawLight(plan_.world, seed);
    return plan_;
  }

 private:
  void DrawSurfaces() {
    world::WorldPlan& world = plan_.world;
    world.wall_material = rng_.Chance(0.75) ? "plaster" : "concrete";
    world.skirting.height_m = rng_.Chance(0.8) ? rng_.Uniform(0.05, 0.1) : 0;
    world.light.floor = OneOf(std::array<std::string, 3>{"lino", "tiles", "carpet"}, rng_);
    world.light.ceiling_m = rng_.Uniform(2.5, 3.0);
    world.light.x_min_m = -1;
    world.light.x_max_m = plan_.length_m + kRoomDepth_m + 1;
    world.light.y_max_m = plan_.width_m / 2 + kRoomDepth_m + 1;
    world.light.y_min_m = -world.light.y_max_m;
    world.brightness_spread = 0.25;
    world.window_spread_deg = 180;
  }

  std::array<Side, 3> Sides() {
    const double half = plan_.width_m / 2, length = plan_.length_m,
                 t = OneOf(std::array{0.1, 0.14, 0.2}, rng_);
    return {{{0, {-1, half + t / 2}, {1, 0}, {0, 1}, length + 1, t},
             {1, {-1, -half - t / 2}, {1, 0}, {0, -1}, length + 1, t},
             {2, {length + t / 2, half + t}, {0, -1}, {1, 0}, 2 * (half + t), t}}};
  }

  void AddWall(const std::string& name, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
               double thickness) {
    plan_.map.walls.push_back({name, {from.x(), from.y()}, {to.x(), to.y()}, thickness});
  }

  void Furnish(const Side& side) {
    double s = rng_.Uniform(1.2, 2.5);
    while (s < side.length_m - 1.2) {
      s += AddSomething(side, s) + rng_.Uniform(0.25, 1.2);
    }
  }

  /// From `s` on; the length it takes [m].
  double AddSomething(const Side& side, double s) {
    const double draw = rng_.Uniform(0, 1);
    if (draw < 0.5) return s + 1.4 < side.length_m ? AddDoor(side, s + 0.65), 1.3 : 1.3;
    if (draw < 0.66) return AddPicture(side, s, rng_.Uniform(0.3, 0.9), rng_.Uniform(0.4, 1.1), "poster");
    if (draw < 0.73) return AddPicture(side, s, rng_.Uniform(1.1, 1.8), rng_.Uniform(0.8, 1.1), "poster");
    if (draw < 0.79) return AddPanel(side, s);
    if (draw < 0.86) return AddWindow(side, s);
    if (draw < 0.93) return AddCupboard(side, s);
    if (draw < 0.97) return AddPillar(side, s);
    return 1;
  }

  double AddDoor(const Side& side, double s) {
    DoorPlan door;
    door.id = static_cast<int>(plan_.map.doors.size()) + 1;
    door.name = fmt::format("door {}", door.id);
    door.opening_width_m = OneOf(std::array{0.76, 0.86, 0.90, 0.96, 1.01}, rng_);
    door.opening_height_m = OneOf(std::array{1.98, 2.00, 2.05, 2.10}, rng_);
    door.wall_thickness_m = side.thickness_m;
    door.frame_width_m = rng_.Uniform(0.04, 0.08);
    door.frame_protrusion_m = rng_.Uniform(0.005, 0.02);
    const bool opens_to_corridor = rng_.Chance(0.2);
    const Eigen::Vector2d at = side.At(s, 0);
    door.x_m = at.x();
    door.y_m = at.y();
    door.yaw_deg = Degrees(WrapAngle(side.YawThrough() + (opens_to_corridor ? kPi : 0)));
    plan_.map.doors.push_back(door);
    plan_.world.doors.push_back(
        {.id = door.id, .hinge = rng_.Chance(0.5) ? "left" : "right", .open_deg = LeafAngle()});
    plan_.world.doors.back().threshold_m = rng_.Chance(0.5) ? 0.008 : 0;
    return door.opening_width_m;
  }

  double LeafAngle() {
    const double draw = rng_.Uniform(0, 1);
    if (draw < 0.5) return 0;
    return draw < 0.65 ? rng_.Uniform(2, 30) : rng_.Uniform(30, 115);
  }

  double AddPicture(const Side& side, double s, double width, double height, const std::string& material,
                    double bottom) {
    plan_.world.posters.push_back({.wall = kWalls[side.number],
                                   .face = side.number == 0 ? "right" : "left",
                                   .along_m = s + width / 2,
                                   .bottom_m = bottom,
                                   .width_m = width,
                                   .height_m = height,
                                   .material = material});
    return width;
  }
  double AddPicture(const Side& side, double s, double width, double height, const std::string& material) {
    return AddPicture(side, s, width, height, material, rng_.Uniform(0.9, 1.3));
  }

  /// Adds a panel as wide and as high up as a door that does not stand on the floor.
  double AddPanel(const Side& side, double s) {
    const double bottom = rng_.Uniform(0.2, 0.6), top = rng_.Uniform(1.8, 2.2);
    const std::string material = OneOf(std::array<std::string, 3>{"wood", "metal", "poster"}, rng_);
    return AddPicture(side, s, rng_.Uniform(0.6, 1.2), top - bottom, material, bottom);
  }

  /// A frame with a brighter pane in it.
  double AddWindow(const Side& side, double s) {
    const double width = rng_.Uniform(0.7, 1.4), bottom = rng_.Uniform(0.8, 1.1),
                 height = rng_.Uniform(0.8, 1.2);
    const double depth = -side.thickness_m / 2 - 0.01;
    AddBox(side, s, width, depth, 0.02, bottom, height, "door_frame");
    AddBox(side, s + 0.06, width - 0.12, depth - 0.011, 0.002, bottom + 0.06, height - 0.12, "ceiling");
    return width;
  }

  double AddCupboard(const Side& side, double s) {
    if (plan_.width_m < 2.1) return 0;
    const double width = rng_.Uniform(0.7, 1.2), deep = rng_.Uniform(0.3, 0.42);
    AddBox(side, s, width, -side.thickness_m / 2 - 0.02 - deep / 2, deep, 0, rng_.Uniform(1.4, 2.1),
           "cupboard");
    return width;
  }

  double AddPillar(const Side& side, double s) {
    const double width = rng_.Uniform(0.25, 0.5), deep = rng_.Uniform(0.05, 0.2);
    AddBox(side, s, width, -side.thickness_m / 2 - deep / 2, deep, 0, plan_.world.light.ceiling_m,
           "concrete");
    return width;
  }

  void AddBox(const Side& side, double s, double along, double depth, double deep, double bottom,
              double height, const std::string& material) {
    const Eigen::Vector2d at = side.At(s + along / 2, depth);
    world::BoxPlan box;
    box.name = material;
    box.x_m = at.x();
    box.y_m = at.y();
    box.yaw_deg = Degrees(side.YawThrough());
    box.length_m = deep;
    box.width_m = along;
    box.bottom_m = bottom;
    box.height_m = height;
    box.material = material;
    plan_.world.boxes.push_back(box);
  }

  /// What is seen through an open door.
  void AddRooms() {
    const double y = plan_.width_m / 2 + kRoomDepth_m, x = plan_.length_m + kRoomDepth_m;
    AddWall("room left", {-1, y}, {x, y}, 0.1);
    AddWall("room right", {-1, -y}, {x, -y}, 0.1);
    AddWall("room end", {x, -y}, {x, y}, 0.1);
    for (double at = 2; at < plan_.length_m; at += rng_.Uniform(1.5, 3)) {
      const bool left = rng_.Chance(0.5);
      plan_.world.posters.push_back({.wall = left ? "room left" : "room right",
                                     .face = left ? "right" : "left",
                                     .along_m = at + 1,
                                     .bottom_m = rng_.Uniform(0.8, 1.3)});
    }
  }

  Rng rng_;
  CorridorPlan plan_;
};

}  // namespace

CorridorPlan DrawCorridor(std::uint64_t seed) {
  return Draughtsman(seed).Draw(seed);
}

}  // namespace priamos::bench
