#include "cli/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace priamos::cli {
namespace {

std::vector<std::string> KnownScenarios(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Scenario LoadScenario(const std::string& folder, const std::string& name) {
  const auto scenarios = std::filesystem::path(folder) / "scenarios";
  const auto known = KnownScenarios(scenarios);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw ConfigError(fmt::format("{}: expected a scenario ({}), got \"{}\"", scenarios.string(),
                                  fmt::join(known, ", "), name));
  }
  return LoadConfig<Scenario>((scenarios / (name + ".toml")).string());
}

GroundPlan LoadPlan(const std::string& folder, const Scenario& scenario) {
  const auto file = (std::filesystem::path(folder) / scenario.map).string();
  const auto plan = LoadConfig<GroundPlan>(file);
  if (!plan.FindDoor(scenario.landmark_id))
    throw ConfigError(fmt::format("{}: expected a door with id {} (landmark_id of the scenario), got none",
                                  file, scenario.landmark_id));
  return plan;
}

}  // namespace priamos::cli
