#include "cli/supervise/scenario_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/config.hpp"
#include "common/input/utf8.hpp"

namespace priamos::cli {
namespace {

constexpr std::size_t kMostOffers = 11, kLongestName = 16, kLongestTitle = 80;  // simulation_t
constexpr std::string_view kMapKey = "map=";

/// What the scenario sets of a module; empty: nothing.
std::string SetOf(const Scenario& scenario, const std::string& module, const std::string& bus) {
  const auto& all = scenario.processes;
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const ScenarioProcess& p) { return p.module == module && p.bus == bus; });
  return at == all.end() ? "" : at->set;
}

/// What sets the map of planner and station. The planner's, when the scenario gives it another one than the
/// true one; nothing in the deployment's own world, of which they have the map already.
std::string MapOf(const Scenario& scenario) {
  std::string set = SetOf(scenario, "planner", "offboard");
  if (set.starts_with(kMapKey)) return set;
  const bool own_world = SetOf(scenario, "world", "onboard").starts_with("world=");
  return own_world ? std::string(kMapKey) + scenario.map : "";
}

}  // namespace

std::vector<OfferedScenario> OfferedScenarios(const Deployment& deployment, const std::string& folder) {
  std::vector<OfferedScenario> offers;
  for (const std::string& name : WordsOfList(deployment.scenarios)) {
    const Scenario scenario = LoadScenario(folder, name);
    if (name.size() > kLongestName)
      throw ConfigError(
          fmt::format("scenarios: expected names of at most {} bytes, got \"{}\"", kLongestName, name));
    offers.push_back({name, std::string(CutUtf8(scenario.title, kLongestTitle))});
  }
  if (offers.size() > kMostOffers)
    throw ConfigError(fmt::format("scenarios: expected at most {}, got {}", kMostOffers, offers.size()));
  return offers;
}

Deployment InScenario(Deployment deployment, const std::string& folder, const std::string& name) {
  const Scenario scenario = LoadScenario(folder, name);
  for (ScenarioProcess& process : deployment.processes) {
    const std::string set = process.module == "planner" || process.module == "console"
                                ? MapOf(scenario)
                                : SetOf(scenario, process.module, process.bus);
    if (!set.empty()) process.set = set;
  }
  return deployment;
}

}  // namespace priamos::cli
