#include "cli/options/folder_options.hpp"

#include <fmt/chrono.h>

#include <CLI/App.hpp>
#include <chrono>
#include <filesystem>

#include "common/data_folders.hpp"

namespace priamos::cli {

void AddDeploymentOption(CLI::App& verb, std::string& deployment) {
  verb.add_option("--deployment", deployment, "sim, robot, or a folder of configurations, with a slash")
      ->capture_default_str();
}

void AddLiveDeploymentOption(CLI::App& verb, std::string& deployment) {
  verb.add_option(
      "--deployment", deployment,
      "sim, robot, or a folder of configurations, with a slash; without it the one that is up, or sim");
}

std::string FolderOfDeployment(const std::string& deployment) {
  return FindDeployment(deployment, ThisProgram());
}

void AddLogsOption(CLI::App& verb, std::string& log_root, const std::string& what) {
  verb.add_option("--logs", log_root,
                  what + "; without it $PRIAMOS_LOGS, ~/.local/state/priamos, or logs of a clone");
}

std::string LogRoot(const std::string& log_root) {
  return log_root.empty() ? LogFolder(ThisProgram()) : log_root;
}

std::string NameByTime() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y%m%d-%H%M%S}", fmt::localtime(now));
}

std::string MakeRunFolder(const std::string& log_root, const std::string& what) {
  const auto folder = std::filesystem::path(log_root) / fmt::format("{}-{}", NameByTime(), what);
  std::filesystem::create_directories(folder);
  return std::filesystem::absolute(folder).string();
}

}  // namespace priamos::cli
