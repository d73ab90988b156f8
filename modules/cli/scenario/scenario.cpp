#include "cli/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/nearest_word.hpp"

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
    throw ConfigError(fmt::format("{}: expected a scenario ({}), got \"{}\"{}", scenarios.string(),
                                  fmt::join(known, ", "), name, NearestText(name, known)));
  }
  return LoadConfig<Scenario>((scenarios / (name + ".toml")).string());
}

std::string MapFile(const std::string& folder, const Scenario& scenario) {
  return (std::filesystem::path(folder) / scenario.map).string();
}

}  // namespace priamos::cli
