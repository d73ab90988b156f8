#include "world/world_loading.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/config.hpp"
#include "world/core/scene/built_doors.hpp"

namespace priamos::world {
namespace {

void CheckMaterials(const std::string& file, const LoadedWorld& world) {
  const auto& known = MaterialNames();
  for (const auto& solid : world.solids)
    if (std::find(known.begin(), known.end(), solid.material) == known.end())
      throw ConfigError(fmt::format("{}: material of \"{}\": expected one of {}, got \"{}\"", file,
                                    solid.name, fmt::join(known, ", "), solid.material));
}

void CheckStart(const std::string& file, const LoadedWorld& world, const Body& body) {
  if (Clearance(body, world.solids).Gap(world.start.truth, 1) > 0) return;
  throw ConfigError(fmt::format("{}: start: expected a free place, got a solid at x {:.2f} m, y {:.2f} m",
                                file, world.start.truth.x, world.start.truth.y));
}

}  // namespace

LoadedWorld LoadWorld(const std::string& name, const std::function<std::string(const std::string&)>& resolve,
                      const Body& body, std::uint64_t seed) {
  LoadedWorld world;
  const std::string file = resolve(name);
  world.plan = LoadConfig<WorldPlan>(file);
  world.map = LoadConfig<GroundPlan>(resolve(world.plan.map));
  world.doors = BuiltDoors(world.map, world.plan, seed);
  world.solids = BuildSolids(world.map, world.plan, seed);
  world.start = DrawStart(world.plan.start, seed);
  world.light = DrawLight(world.plan, seed);
  if (!world.plan.reference.object.empty()) {
    const auto object = LoadConfig<ReferenceObject>(resolve(world.plan.reference.object));
    world.reference = PlaceReference(world.plan.reference, object, world.start.truth, seed);
  }
  CheckMaterials(file, world);
  CheckStart(file, world, body);
  return world;
}

}  // namespace priamos::world
