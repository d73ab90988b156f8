#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/scenario/scenario.hpp"
#include "world/world_loading.hpp"

namespace priamos::cli {

/// True body and solids of the simulated world, map frame. Only reports may use them.
struct TrueWorld {
  world::Body body;
  std::vector<world::Solid> solids;
  std::vector<DoorPlan> doors{};  ///< as they were built
};

/// The world as the scenario's process `world` draws it from `seed`; empty if the scenario has none. `folder`
/// is the deployment's. Throws ConfigError.
TrueWorld LoadTrueWorld(const std::string& folder, const Scenario& scenario, std::uint64_t seed);

}  // namespace priamos::cli
