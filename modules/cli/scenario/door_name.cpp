#include "cli/scenario/door_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "bus/process_config.hpp"
#include "common/config.hpp"
#include "common/ground_plan.hpp"
#include "common/text/nearest_word.hpp"
#include "common/text/number_text.hpp"
#include "planner/planner_config.hpp"

namespace priamos::cli {

int DoorNamed(const GroundPlan& plan, const std::string& name, const std::string& map) {
  std::vector<std::string> known;
  for (const DoorPlan& door : plan.doors) {
    if (door.name == name) return door.id;
    known.push_back(door.name);
  }
  const auto id = NumberOf<int>(name);
  if (id && *id >= kFirstLandmarkId && *id <= kLastLandmarkId) return *id;
  throw ConfigError(fmt::format("unknown door \"{}\"{}; {} has {}", name, NearestText(name, known), map,
                                known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

int DoorOfPlanner(const ConfigSource& planner, const std::string& name) {
  const auto config = bus::LoadAppConfig<planner::PlannerConfig>(planner);
  const std::string map = (std::filesystem::path(planner.Folder()) / config.map).lexically_normal().string();
  return DoorNamed(LoadConfig<GroundPlan>(map), name, map);
}

}  // namespace priamos::cli
