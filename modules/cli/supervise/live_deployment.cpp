#include "cli/supervise/live_deployment.hpp"

#include <filesystem>

#include "cli/supervise/supervisor_search.hpp"
#include "cli/supervise/up_state.hpp"
#include "common/data_folders.hpp"

namespace priamos::cli {
namespace {

ConfigSource PlannerIn(const std::string& config_folder) {
  return {(std::filesystem::path(config_folder) / "planner.toml").string(), {}};
}

}  // namespace

std::string LogRootInUse(const std::string& log_root, const std::string& robot, const std::string& network) {
  if (UpLock::Holder(log_root)) return log_root;
  const auto found = FindSupervisor(robot, network);
  return found && found->log_root ? *found->log_root : log_root;
}

ConfigSource PlannerInUse(const std::string& named, const std::string& log_root) {
  if (!named.empty()) return PlannerIn(FindDeployment(named, ThisProgram()));
  const auto up = UpLock::Holder(log_root) ? ReadUpState(log_root) : std::nullopt;
  if (!up) return PlannerIn(FindDeployment("sim", ThisProgram()));
  ConfigSource source = PlannerIn(up->config_folder);
  if (!up->planner_set.empty()) source.overrides.push_back(up->planner_set);
  return source;
}

}  // namespace priamos::cli
