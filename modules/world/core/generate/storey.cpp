#include "world/core/generate/storey.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "world/core/generate/clutter.hpp"
#include "world/core/generate/sketch.hpp"

namespace priamos::world {
namespace {

using Eigen::Vector2d;

/// Between an opening and the corner of its room.
constexpr double kPier_m = 0.5;

/// A storey under construction.
class Storey {
 public:
  explicit Storey(std::uint64_t seed) : rng_(Rng::Stream(seed, "storey")) {}

  GeneratedWorld Build() {
    length_m_ = rng_.Uniform(14, 34);
    half_m_ = rng_.Uniform(1.8, 2.6) / 2;
    const double y = half_m_ + kHalfWall_m;
    Wall("west end", {-kHalfWall_m, -y}, {-kHalfWall_m, y});
    SketchWall& east = Wall("east end", {length_m_ + kHalfWall_m, -y}, {length_m_ + kHalfWall_m, y});
    ClosedDoor(east, y);
    Rooms("south", -1);
    Rooms("north", 1);
    out_.world.start = StartPlan{1.5, 0, rng_.Uniform(-10, 10), 0, 0, 0, 0.01, 0.2};
    out_.waypoints = {{length_m_ / 2, 0, 0}, {length_m_ - 1.5, 0, 0}};
    return Finish();
  }

 private:
  SketchWall& Wall(const std::string& name, const Vector2d& from, const Vector2d& to) {
    sketch_.walls.push_back({name, from, to, {}});
    return sketch_.walls.back();
  }

  void ClosedDoor(SketchWall& wall, double along_m) {
    DoorPlan door;
    door.id = ++doors_;
    door.name = fmt::format("door {}", door.id);
    wall.doors.push_back({along_m, false, door});
    DoorWork leaf;
    leaf.id = door.id;
    leaf.open_deg = 0;
    out_.world.doors.push_back(leaf);
  }

  /// The rooms on one side of the corridor, from its beginning to its end.
  void Rooms(const std::string& side, double sign) {
    const double near = sign * (half_m_ + kHalfWall_m),
                 far = near + sign * (rng_.Uniform(3.5, 6) + 2 * kHalfWall_m);
    double begin_m = -kHalfWall_m;
    Wall(side + " first", {begin_m, near}, {begin_m, far});
    for (int i = 1; begin_m < length_m_; ++i) {
      double end_m = begin_m + rng_.Uniform(4, 7);
      if (end_m > length_m_ - 4) end_m = length_m_ + kHalfWall_m;
      const std::string name = fmt::format("{} {}", side, i);
      Wall(name + " back", {begin_m, far}, {end_m, far});
      Wall(name + " side", {end_m, near}, {end_m, far});
      Front(name + " front", {begin_m, near}, {end_m, near}, sign);
      Furnish({begin_m + kHalfWall_m, std::min(near, far) + kHalfWall_m},
              {end_m - kHalfWall_m, std::max(near, far) - kHalfWall_m});
      begin_m = end_m;
    }
  }

  /// The wall between a room and the corridor, open or with a closed door.
  void Front(const std::string& name, const Vector2d& from, const Vector2d& to, double sign) {
    const double length_m = to.x() - from.x();
    if (rng_.Chance(0.15)) {
      SketchWall& wall = Wall(name, from, to);
      ClosedDoor(wall, rng_.Uniform(1, length_m - 1));
      wall.doors.back().to_left = sign > 0;
      return;
    }
    const double half_m = rng_.Uniform(1.2, 1.7) / 2, inside_m = kPier_m + half_m;
    opening_m_ = from.x() + rng_.Uniform(inside_m, length_m - inside_m);
    Wall(name + ", first", from, {opening_m_ - half_m, from.y()});
    Wall(name + ", second", {opening_m_ + half_m, from.y()}, to);
  }

  /// Cupboards that leave the way in free.
  void Furnish(const Vector2d& low, const Vector2d& high) {
    const Vector2d middle = (low + high) / 2;
    const double near = middle.y() > 0 ? low.y() : high.y();
    const Lane lane{{{opening_m_, near}, {opening_m_, middle.y()}, middle}, 0.9};
    const auto is_free = [&](const Vector2d& at, double radius) { return lane.DistanceTo(at) >= radius; };
    for (auto n = rng_.Below(3); n > 0; --n) {
      BoxPlan cupboard = DrawThing("cupboard", rng_);
      cupboard.yaw_deg = 90 * double(rng_.Below(2));
      if (PlaceThing({low, high}, is_free, out_.world, rng_, cupboard))
        AddThing("cupboard", cupboard, out_.world);
    }
  }

  GeneratedWorld Finish() {
    Eigen::AlignedBox2d box;
    for (const SketchWall& wall : sketch_.walls) box.extend(wall.from).extend(wall.to);
    SceneConfig& light = out_.world.light;
    light.x_min_m = box.min().x() - 2;
    light.x_max_m = box.max().x() + 2;
    light.y_min_m = box.min().y() - 2;
    light.y_max_m = box.max().y() + 2;
    light.floor = "lino";
    out_.truth = PlanOf(sketch_);
    out_.surveyed = PlanOf(Surveyed(sketch_, rng_));
    out_.surveyed.wall_sigma_m = kSurveyedWall_m;
    return std::move(out_);
  }

  Rng rng_;
  Sketch sketch_;
  GeneratedWorld out_;
  int doors_ = 0;
  double length_m_ = 0, half_m_ = 0;
  double opening_m_ = 0;  ///< of the room under construction
};

}  // namespace

GeneratedWorld GenerateStorey(std::uint64_t seed) {
  return Storey(seed).Build();
}

}  // namespace priamos::world
