#include "world/core/scene/plan_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace priamos::world {
namespace {

const WallPlan& WallOf(const GroundPlan& map, const std::string& name, const SectionPlace& place) {
  const auto wall =
      std::find_if(map.walls.begin(), map.walls.end(), [&](const WallPlan& w) { return w.name == name; });
  if (wall == map.walls.end())
    throw ConfigError(
        fmt::format("{}: expected the name of a wall of the map, got \"{}\"", place.Of("wall"), name));
  return *wall;
}

void CheckSurfaces(const WorldPlan& plan, const GroundPlan& map) {
  std::set<std::string> walls;
  for (const WallSurface& surface : plan.surfaces) {
    WallOf(map, surface.wall, surface.place);
    if (!walls.insert(surface.wall).second)
      throw ConfigError(fmt::format("{}: expected one surface per wall, got \"{}\" twice",
                                    surface.place.Of("wall"), surface.wall));
  }
}

void CheckDoors(const WorldPlan& plan, const GroundPlan& map) {
  std::set<int> doors;
  for (const DoorWork& work : plan.doors) {
    if (!map.FindDoor(work.id))
      throw ConfigError(
          fmt::format("{}: expected the id of a door of the map, got {}", work.place.Of("id"), work.id));
    if (!doors.insert(work.id).second)
      throw ConfigError(
          fmt::format("{}: expected each door once, got {} twice", work.place.Of("id"), work.id));
  }
}

void CheckPosters(const WorldPlan& plan, const GroundPlan& map) {
  for (const PosterPlan& poster : plan.posters) {
    const WallPlan& wall = WallOf(map, poster.wall, poster.place);
    const double length_m = (wall.to() - wall.from()).norm(), half_m = poster.width_m / 2;
    if (poster.along_m < half_m || poster.along_m > length_m - half_m)
      throw ConfigError(
          fmt::format("{}: expected a poster of {:.2f} m to hang on \"{}\", which is {:.2f} m long, got its "
                      "middle at {:.2f} m",
                      poster.place.Of("along_m"), poster.width_m, wall.name, length_m, poster.along_m));
  }
}

}  // namespace

void CheckAgainstMap(const WorldPlan& plan, const GroundPlan& map) {
  CheckSurfaces(plan, map);
  CheckDoors(plan, map);
  CheckPosters(plan, map);
}

}  // namespace priamos::world
