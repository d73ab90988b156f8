#include "cli/scenario/true_world.hpp"

#include <algorithm>
#include <filesystem>

#include "bus/process_config.hpp"
#include "world/world_config.hpp"
#include "world/world_loading.hpp"

namespace priamos::cli {

TrueWorld LoadTrueWorld(const std::string& folder, const Scenario& scenario, std::uint64_t seed) {
  const auto process = std::find_if(scenario.processes.begin(), scenario.processes.end(),
                                    [](const ScenarioProcess& p) { return p.module == "world"; });
  if (process == scenario.processes.end()) return {};
  ConfigSource source{(std::filesystem::path(folder) / process->config).string(), {}};
  if (!process->set.empty()) source.overrides.push_back(process->set);
  const auto config = bus::LoadAppConfig<world::WorldConfig>(source);
  const world::Body body = world::BodyOf(config.robot);
  const auto resolve = [&](const std::string& name) {
    return (std::filesystem::path(source.Folder()) / name).lexically_normal().string();
  };
  auto loaded = world::LoadWorld(config.world, resolve, body, seed);
  return {body, std::move(loaded.solids), std::move(loaded.doors)};
}

}  // namespace priamos::cli
