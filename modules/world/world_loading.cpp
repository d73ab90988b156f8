#include "world/world_loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/config.hpp"
#include "common/input/regular_file.hpp"
#include "common/rectangle.hpp"
#include "world/core/base/start_anywhere.hpp"
#include "world/core/generate/strew.hpp"
#include "world/core/scene/built_doors.hpp"
#include "world/core/scene/outline.hpp"
#include "world/core/scene/plan_checks.hpp"

namespace priamos::world {
namespace {

void CheckStart(const std::string& file, const LoadedWorld& world, const Body& body) {
  if (Clearance(body, world.solids).Gap(world.start.truth, 1) > 0) return;
  throw ConfigError(fmt::format("{}: start: expected a free place, got a solid at x {:.2f} m, y {:.2f} m",
                                file, world.start.truth.x, world.start.truth.y));
}

/// A person needs so much room at a waypoint.
constexpr double kPersonRadius_m = 0.25;
constexpr double kKnee_m = 0.15, kHead_m = 1.75;

void CheckPeople(const LoadedWorld& world, const Body& body) {
  const Rectangle robot{world.start.truth, body.size_m / 2};
  for (const PersonPlan& person : world.hazards.people) {
    if (const PersonStop& first = person.waypoints.front();
        Distance(robot, Eigen::Vector2d(first.x_m, first.y_m)) < kPersonRadius_m)
      throw ConfigError(
          fmt::format("{}people: expected \"{}\" beside the robot at the beginning, got x {:.2f} m, "
                      "y {:.2f} m, where it starts; next: move one of them",
                      person.place.Begin(), person.name, first.x_m, first.y_m));
    for (const PersonStop& stop : person.waypoints)
      for (const Solid& solid : world.solids)
        if (Overlaps(solid, kKnee_m, kHead_m) &&
            Distance(OutlineOf(solid), Eigen::Vector2d(stop.x_m, stop.y_m)) < kPersonRadius_m)
          throw ConfigError(fmt::format(
              "{}people: expected {:.2f} m of room around the waypoint at x {:.2f} m, "
              "y {:.2f} m of \"{}\", got \"{}\"; next: move it, or make spread_m smaller",
              person.place.Begin(), kPersonRadius_m, stop.x_m, stop.y_m, person.name, solid.name));
  }
}

void CheckHoles(const LoadedWorld& world, const Body& body) {
  const Rectangle footprint{world.start.truth, body.size_m / 2};
  for (const HolePlan& hole : world.hazards.holes)
    if (Distance(footprint, Rectangle{{hole.x_m, hole.y_m, 0}, {hole.length_m / 2, hole.width_m / 2}}) <= 0)
      throw ConfigError(
          fmt::format("{}holes: expected floor below the start, got \"{}\"", hole.place.Begin(), hole.name));
}

/// A file that a world names, when there is one.
std::string FileOf(const std::string& asked_by, std::string path) {
  const RegularFile file(path);
  if (!file.open())
    throw ConfigError(fmt::format("{}: expected a file, got {}, \"{}\"", asked_by, file.problem(), path));
  return path;
}

/// All of a file.
std::string ContentOf(const std::string& path, const std::string& asked_by) {
  constexpr std::size_t kMost_MB = 128;
  const RegularFile file(path);
  if (!file.open())
    throw ConfigError(fmt::format("{}expected a file, got {}, \"{}\"", asked_by, file.problem(), path));
  auto content = file.Read(kMost_MB << 20);
  if (!content)
    throw ConfigError(
        fmt::format("{}expected a file of at most {} MB, got \"{}\"", asked_by, kMost_MB, path));
  return std::move(*content);
}

/// Walls from a map of ROS; its picture lies beside its YAML file, or where that says.
std::vector<Solid> WallsOfGrid(const LoadedWorld& world,
                               const std::function<std::string(const std::string&)>& resolve) {
  const GridPlan& plan = world.plan.grid;
  if (plan.yaml.empty()) return {};
  const std::string yaml = resolve(plan.yaml);
  const GridHeader header = ParseGridHeader(yaml, ContentOf(yaml, plan.place.Begin() + "grid.yaml: "));
  const std::string image = (std::filesystem::path(yaml).parent_path() / header.image).string();
  const OccupancyGrid grid = ParseGrid(header, image, ContentOf(image, yaml + ": image: "));
  const StartPlan& start = world.plan.start;
  return GridSolids(grid, plan, {start.x_m, start.y_m}, world.plan.light.ceiling_m);
}

/// The leaves that somebody moves; a door that the world does not list has no leaf.
std::vector<MovedLeaf> MovedLeaves(const LoadedWorld& world) {
  std::vector<MovedLeaf> leaves;
  for (const DoorWork& work : world.plan.doors)
    for (const DoorPlan& door : world.doors)
      if (door.id == work.id && !work.swings.empty())
        leaves.push_back({door, work.hinge, work.leaf_thickness_m, LeafName(door), work.swings});
  return leaves;
}

Hazards HazardsOf(const LoadedWorld& world, std::uint64_t seed) {
  Hazards hazards{{}, MovedLeaves(world), world.plan.holes, world.plan.faults, world.plan.mast};
  for (const PersonPlan& person : world.plan.people) hazards.people.push_back(DrawPerson(person, seed));
  return hazards;
}

}  // namespace

LoadedWorld LoadWorld(const std::string& name, const std::function<std::string(const std::string&)>& resolve,
                      const Body& body, std::uint64_t seed) {
  LoadedWorld world;
  const std::string file = resolve(name);
  world.plan = OfTheDay(LoadConfig<WorldPlan>(file), seed);
  world.map = LoadConfig<GroundPlan>(FileOf(world.plan.place.Of("map"), resolve(world.plan.map)));
  CheckAgainstMap(world.plan, world.map);
  world.doors = BuiltDoors(world.map, world.plan, seed);
  world.solids = BuildSolids(world.map, world.plan, seed);
  for (Solid& wall : WallsOfGrid(world, resolve)) world.solids.push_back(std::move(wall));
  world.hazards = HazardsOf(world, seed);
  world.start = DrawStart(world.plan.start, seed);
  if (world.plan.start.anywhere)
    world.start.truth =
        DrawFreePlace(world.map, body, world.solids, world.hazards, seed).value_or(world.start.truth);
  world.light = DrawLight(world.plan, seed);
  if (!world.plan.reference.object.empty()) {
    const auto object = LoadConfig<ReferenceObject>(
        FileOf(world.plan.reference.place.Of("object"), resolve(world.plan.reference.object)));
    world.reference = PlaceReference(world.plan.reference, object, world.start.truth, seed);
  }
  world.quirks = DrawQuirks(world.plan.cameras, seed);
  CheckPeople(world, body);
  CheckHoles(world, body);
  CheckStart(file, world, body);
  return world;
}

}  // namespace priamos::world
