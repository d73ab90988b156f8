#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "world/core/base/contact.hpp"
#include "world/core/scene/build_solids.hpp"
#include "world/core/scene/camera_quirks.hpp"
#include "world/core/scene/hazards.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// A world of one seed, ready to be simulated.
struct LoadedWorld {
  WorldPlan plan;
  GroundPlan map;
  std::vector<DoorPlan> doors;  ///< as they were built, in the order of the map
  std::vector<Solid> solids;
  Start start;
  SceneConfig light;
  std::optional<PlacedReference> reference;
  Hazards hazards;  ///< people, holes and all else that a robot may meet
  CameraQuirks quirks;
};

/// Reads the world file `name`, and the map and reference object it names; `resolve` finds files of the
/// deployment. Throws ConfigError with a sentence, also for a material that nothing is known about, for a
/// start inside a solid or over a hole, and for a person whose waypoint is in a wall.
LoadedWorld LoadWorld(const std::string& name, const std::function<std::string(const std::string&)>& resolve,
                      const Body& body, std::uint64_t seed);

}  // namespace priamos::world
