#include "world/core/generate/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "world/core/generate/clutter.hpp"
#include "world/core/generate/sketch.hpp"
#include "world/core/generate/storey.hpp"

namespace priamos::world {
namespace {

using Eigen::Vector2d;

/// Walls of a sketch are centre lines; rooms are spoken of by their inner size.
constexpr double kCeiling_m = 2.8;
/// So far before a wall is the middle of a base that comes no nearer.
constexpr double kStands_m = 0.6;
/// So far within the other corridor somebody is out of the way.
constexpr double kAside_m = 2.5;
/// Number of a door's landmark for who comes back through it, less the door's.
constexpr int kBehind = 100;

DoorPlan DrawDoor(int id, const std::string& name, double narrowest_m, Rng& rng) {
  DoorPlan door;
  door.id = id;
  door.behind_id = kBehind + id;
  door.name = name;
  door.opening_width_m = rng.Uniform(narrowest_m, 1.0);
  door.opening_height_m = rng.Uniform(1.98, 2.12);
  door.frame_width_m = rng.Uniform(0.05, 0.08);
  door.frame_protrusion_m = rng.Uniform(0.01, 0.02);
  door.rebate_depth_m = 0.04;
  return door;
}

DoorWork DrawLeaf(int id, double least_deg, double most_deg, Rng& rng) {
  DoorWork work;
  work.id = id;
  work.hinge = rng.Chance(0.5) ? "left" : "right";
  work.open_deg = rng.Uniform(least_deg, most_deg);
  return work;
}

/// A building under construction.
class Building {
 public:
  explicit Building(std::uint64_t seed) : rng_(Rng::Stream(seed, "generate")) {
    const auto one_of = [this](std::initializer_list<const char*> words) {
      return std::string(*(words.begin() + rng_.Below(words.size())));
    };
    out_.world.wall_material = one_of({"plaster", "plaster", "concrete", "wood"});
    out_.world.light.floor = one_of({"lino", "tiles", "carpet"});
    out_.world.light.ceiling_m = kCeiling_m;
    out_.world.light.brightness = rng_.Uniform(0.8, 1.5);
    out_.world.light.window_yaw_deg = rng_.Uniform(-180, 180);
  }

  GeneratedWorld Room();
  GeneratedWorld Corridor();
  GeneratedWorld Floor();

 private:
  SketchWall& Wall(const std::string& name, const Vector2d& from, const Vector2d& to) {
    sketch_.walls.push_back({name, from, to, {}});
    return sketch_.walls.back();
  }
  /// Inner rectangle of a room; its west side may be left open.
  void Rectangle(const std::string& name, const Vector2d& low, const Vector2d& high, bool west);
  void Door(SketchWall& wall, double along_m, bool to_left, double narrowest_m, bool to_pass);
  void SideDoors(SketchWall& wall, double from_m, double to_m, bool to_left);
  void Walker(const std::vector<Vector2d>& waypoints);
  void Start(const Vector2d& at, double towards_deg);
  void Round(const Vector2d& door, const Vector2d& back);
  double CorridorSides(double length_m, double width_m, double first_door_m);
  GeneratedWorld Finish();

  Rng rng_;
  Sketch sketch_;
  GeneratedWorld out_;
  int doors_ = 0;
};

void Building::Rectangle(const std::string& name, const Vector2d& low, const Vector2d& high, bool west) {
  const Vector2d a = low - Vector2d::Constant(kHalfWall_m), b = high + Vector2d::Constant(kHalfWall_m);
  Wall(name + " south", {a.x(), a.y()}, {b.x(), a.y()});
  Wall(name + " east", {b.x(), a.y()}, {b.x(), b.y()});
  Wall(name + " north", {a.x(), b.y()}, {b.x(), b.y()});
  if (west) Wall(name + " west", {a.x(), a.y()}, {a.x(), b.y()});
}

void Building::Door(SketchWall& wall, double along_m, bool to_left, double narrowest_m, bool to_pass) {
  const int id = ++doors_;
  wall.doors.push_back({along_m, to_left, DrawDoor(id, fmt::format("door {}", id), narrowest_m, rng_)});
  if (to_pass) out_.door_id = id;
  out_.world.doors.push_back(to_pass ? DrawLeaf(id, 92, 110, rng_)
                                     : DrawLeaf(id, 0, rng_.Chance(0.5) ? 0 : 80, rng_));
}

/// A door every 3 to 7 m.
void Building::SideDoors(SketchWall& wall, double from_m, double to_m, bool to_left) {
  for (double at = from_m + rng_.Uniform(1, 4); at < to_m - 1; at += rng_.Uniform(3, 7))
    Door(wall, at, to_left, 0.8, false);
}

/// Somebody who goes there and back; the ends are where they stand a while.
void Building::Walker(const std::vector<Vector2d>& waypoints) {
  PersonPlan person;
  person.name = fmt::format("person {}", out_.world.people.size() + 1);
  person.speed_m_s = rng_.Uniform(0.5, 1.2);
  person.attentive = rng_.Chance(0.8);
  for (const Vector2d& at : waypoints) person.waypoints.push_back({at.x(), at.y(), 0, 0});
  person.waypoints.front().pause_s = rng_.Uniform(0, 5);
  person.waypoints.back().pause_s = rng_.Uniform(0, 5);
  for (std::size_t i = waypoints.size() - 2; i > 0; --i)
    person.waypoints.push_back({waypoints[i].x(), waypoints[i].y(), 0, 0});
  person.start_s = rng_.Uniform(0, 10);
  out_.world.people.push_back(person);
}

void Building::Start(const Vector2d& at, double towards_deg) {
  StartPlan& start = out_.world.start;
  start = StartPlan{at.x(), at.y(), towards_deg, 0, 0, 0, 0.15, 4};
}

/// To a place behind a door that leads along x, and back; both in the free lane.
void Building::Round(const Vector2d& door, const Vector2d& back) {
  constexpr double kBehind_m = 2;
  out_.round = {{door.x() + kBehind_m, door.y(), 0}, {back.x(), back.y(), kPi}};
}

GeneratedWorld Building::Finish() {
  Vector2d low = sketch_.walls.front().from, high = low;
  for (const SketchWall& wall : sketch_.walls)
    for (const Vector2d& end : {wall.from, wall.to}) {
      low = low.cwiseMin(end);
      high = high.cwiseMax(end);
    }
  SceneConfig& light = out_.world.light;
  light.x_min_m = low.x() - 2;
  light.x_max_m = high.x() + 2;
  light.y_min_m = low.y() - 2;
  light.y_max_m = high.y() + 2;
  out_.truth = PlanOf(sketch_);
  out_.surveyed = PlanOf(Surveyed(sketch_, rng_));
  out_.surveyed.wall_sigma_m = kSurveyedWall_m;
  return std::move(out_);
}

GeneratedWorld Building::Room() {
  const double depth = rng_.Uniform(3.6, 6), near = rng_.Uniform(5.5, 8), far = rng_.Uniform(3.5, 5);
  Rectangle("room", {0, 0}, {near + 2 * kHalfWall_m + far, depth}, true);
  const double door_y = rng_.Uniform(1.3, depth - 1.3);
  SketchWall& middle =
      Wall("middle", {near + kHalfWall_m, -kHalfWall_m}, {near + kHalfWall_m, depth + kHalfWall_m});
  Door(middle, door_y + kHalfWall_m, false, 0.88, true);
  const Vector2d door(near, door_y);
  const double before_m = rng_.Uniform(3, 4.3), beside_m = rng_.Uniform(-0.8, 0.8);
  const Vector2d start(near - before_m, std::clamp(door_y + beside_m, 0.95, depth - 0.95));
  const Vector2d to_door = door - start;
  Start(start, Degrees(std::atan2(to_door.y(), to_door.x())) + rng_.Uniform(-15, 15));
  Round(door, start);
  const Lane lane{{start, door - Vector2d(1.8, 0), door + Vector2d(2.2, 0)}, 0.85};
  AddClutter({{0.1, 0.1}, {near - 0.1, depth - 0.1}}, lane, 3 + static_cast<int>(rng_.Below(5)), rng_,
             out_.world);
  AddClutter({{near + 0.2, 0.1}, {near + far, depth - 0.1}}, lane, static_cast<int>(rng_.Below(4)), rng_,
             out_.world);
  return Finish();
}

/// The sides of a corridor along x with one corridor that leaves it to the north. Returns where that does.
double Building::CorridorSides(double length_m, double width_m, double first_door_m) {
  const double y = width_m / 2 + kHalfWall_m, side_m = rng_.Uniform(1.6, 3), deep_m = rng_.Uniform(5, 10);
  const double junction_m = rng_.Uniform(0.35, 0.6) * length_m;
  SideDoors(Wall("south", {-kHalfWall_m, -y}, {length_m, -y}), first_door_m, length_m, false);
  SideDoors(Wall("north", {-kHalfWall_m, y}, {junction_m - side_m / 2, y}), first_door_m,
            junction_m - side_m / 2, true);
  Wall("north beyond", {junction_m + side_m / 2, y}, {length_m, y});
  for (const double x : {junction_m - side_m / 2 - kHalfWall_m, junction_m + side_m / 2 + kHalfWall_m})
    Wall(x < junction_m ? "junction west" : "junction east", {x, y}, {x, y + deep_m});
  Wall("junction end", {junction_m - side_m / 2, y + deep_m}, {junction_m + side_m / 2, y + deep_m});
  Wall("west", {-kHalfWall_m, -y}, {-kHalfWall_m, y});
  return junction_m;
}

GeneratedWorld Building::Corridor() {
  const double length_m = rng_.Uniform(20, 80), width_m = rng_.Uniform(1.6, 3);
  const double junction_m = CorridorSides(length_m, width_m, 1);
  Wall("east", {length_m + kHalfWall_m, -width_m / 2}, {length_m + kHalfWall_m, width_m / 2});
  out_.corridor_end = Pose2{length_m - kStands_m, 0, 0};
  const double begin_m = rng_.Uniform(1.5, 3), lane_y = rng_.Uniform(-1, 1) * (width_m / 2 - 0.7);
  Start({begin_m, lane_y}, rng_.Uniform(-8, 8));
  double at = begin_m;
  for (int i = 0; i < 3 && at < length_m - 3; ++i) {
    at = std::min(at + rng_.Uniform(4, 7), length_m - 1.5);
    out_.waypoints.push_back({at, lane_y, 0});
  }
  const Lane lane{{{begin_m - 1, lane_y}, {length_m, lane_y}}, 0.625};
  AddClutter({{0.1, -width_m / 2 + 0.02}, {length_m - 0.1, width_m / 2 - 0.02}}, lane,
             static_cast<int>(length_m / 3), rng_, out_.world);
  const auto people = static_cast<int>(rng_.Below(3));
  // Who meets the base where two cannot pass each other turns back, and has somewhere to go.
  const Vector2d aside(junction_m, width_m / 2 + kAside_m);
  for (int i = 0; i < people; ++i) Walker({aside, {junction_m, lane_y}, {begin_m + 2, lane_y}});
  return Finish();
}

GeneratedWorld Building::Floor() {
  const double length_m = rng_.Uniform(20, 40), width_m = rng_.Uniform(1.8, 3);
  const double junction_m = CorridorSides(length_m, width_m, 1);
  const double room_m = rng_.Uniform(3.5, 5), half = room_m / 2;
  const double x = length_m + kHalfWall_m;
  const double door_y = rng_.Uniform(-1, 1) * (width_m / 2 - 0.75);
  SketchWall& end = Wall("end", {x, -half}, {x, half});
  Door(end, door_y + half, false, 0.88, true);
  Rectangle("room", {x + kHalfWall_m, -half}, {x + kHalfWall_m + rng_.Uniform(3.5, 5), half}, false);
  const Vector2d door(length_m, door_y);
  const double before_m = rng_.Uniform(3, 4.3), beside_m = rng_.Uniform(-0.3, 0.3);
  const Vector2d start(length_m - before_m,
                       std::clamp(door_y + beside_m, -width_m / 2 + 0.75, width_m / 2 - 0.75));
  Start(start, rng_.Uniform(-10, 10));
  const Vector2d junction(junction_m, start.y());
  Round(door, junction);
  const Lane lane{{junction, start, door - Vector2d(1.5, 0), door + Vector2d(2.2, 0)}, 0.7};
  AddClutter({{0.1, -width_m / 2 + 0.02}, {length_m - 0.1, width_m / 2 - 0.02}}, lane,
             static_cast<int>(length_m / 3), rng_, out_.world);
  AddClutter({{x + 0.3, -half + 0.1}, {x + 3.4, half - 0.1}}, lane, static_cast<int>(rng_.Below(4)), rng_,
             out_.world);
  if (rng_.Chance(0.5)) Walker({{junction_m, 3}, junction, start - Vector2d(3, 0)});
  return Finish();
}

}  // namespace

const std::vector<std::string>& GeneratedKinds() {
  static const std::vector<std::string> kKinds{"floor", "corridor", "room", "storey"};
  return kKinds;
}

GeneratedWorld Generate(const std::string& kind, std::uint64_t seed) {
  if (kind == "storey") return GenerateStorey(seed);
  Building building(seed);
  if (kind == "floor") return building.Floor();
  if (kind == "corridor") return building.Corridor();
  if (kind == "room") return building.Room();
  throw std::invalid_argument("no kind \"" + kind + "\"");
}

}  // namespace priamos::world
