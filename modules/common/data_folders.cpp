#include "common/data_folders.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "common/config.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos {
namespace {

namespace fs = std::filesystem;

std::string Environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The clone that the build folder around `program_folder` belongs to: CMake left its address there.
fs::path CloneOf(const fs::path& program_folder) {
  constexpr std::string_view kKey = "CMAKE_HOME_DIRECTORY:INTERNAL=";
  std::ifstream cache(program_folder.parent_path() / "CMakeCache.txt");
  for (std::string line; std::getline(cache, line);)
    if (line.starts_with(kKey)) return line.substr(kKey.size());
  return {};
}

/// A relative path in an XDG variable does not count, as their specification says.
fs::path XdgFolder(const std::string& variable, const std::string& home, const char* below_home) {
  if (fs::path(variable).is_absolute()) return variable;
  return home.empty() ? fs::path() : fs::path(home) / below_home;
}

std::vector<fs::path> XdgConfigFolders(const ProgramPlace& place) {
  std::vector<fs::path> folders{XdgFolder(place.config_home, place.home, ".config")};
  std::istringstream list(place.config_dirs.empty() ? "/etc/xdg" : place.config_dirs);
  for (std::string folder; std::getline(list, folder, ':');) folders.push_back(folder);
  std::erase_if(folders, [](const fs::path& folder) { return !folder.is_absolute(); });
  return folders;
}

[[noreturn]] void RefuseDeployment(const std::string& given, const ProgramPlace& place) {
  std::vector<std::string> places;
  for (const auto& root : DeploymentRoots(place)) places.push_back(root.string());
  const std::string here =
      fs::is_directory(given) ? fmt::format("; the one in this folder is ./{}", given) : "";
  const auto known = KnownDeployments(place);
  if (known.empty())
    throw ConfigError(
        fmt::format("deployment: expected a folder (with a slash), got \"{}\"{}; none was found in {}", given,
                    here, fmt::join(places, ", ")));
  throw ConfigError(
      fmt::format("deployment: expected one of {}, or a folder (with a slash), got \"{}\"{}{}; looked in {}",
                  fmt::join(known, ", "), given, NearestText(given, known), here, fmt::join(places, ", ")));
}

}  // namespace

ProgramPlace ThisProgram() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  return {folder,
          CloneOf(folder),
          Environment("PRIAMOS_DATA"),
          Environment("PRIAMOS_LOGS"),
          Environment("HOME"),
          Environment("XDG_CONFIG_HOME"),
          Environment("XDG_CONFIG_DIRS"),
          Environment("XDG_STATE_HOME")};
}

fs::path SystemConfigFolder(const fs::path& prefix) {
  return prefix == "/usr" ? fs::path("/etc") : prefix / "etc";
}

std::vector<fs::path> DeploymentRoots(const ProgramPlace& place) {
  std::vector<fs::path> roots;
  if (!place.data.empty()) roots.push_back(fs::path(place.data) / "config");
  for (const auto& folder : XdgConfigFolders(place)) roots.push_back(folder / "priamos");
  if (!place.clone.empty()) {
    roots.push_back(place.clone / "config");
    return roots;
  }
  const fs::path prefix = place.program_folder.parent_path();
  roots.push_back(SystemConfigFolder(prefix) / "priamos");
  roots.push_back(prefix / "share/priamos/config");
  return roots;
}

std::vector<std::string> KnownDeployments(const ProgramPlace& place) {
  std::set<std::string> names;
  for (const auto& root : DeploymentRoots(place)) {
    std::error_code not_there;
    for (const auto& entry : fs::directory_iterator(root, not_there))
      if (fs::exists(entry.path() / "deployment.toml")) names.insert(entry.path().filename());
  }
  return {names.begin(), names.end()};
}

std::string FindDeployment(const std::string& given, const ProgramPlace& place) {
  if (given.find('/') != std::string::npos) {
    if (fs::is_directory(given)) return given;
    throw ConfigError(fmt::format("{}: expected the folder of a deployment, got none", given));
  }
  if (!place.data.empty() && !fs::is_directory(fs::path(place.data) / "config"))
    throw ConfigError(
        fmt::format("PRIAMOS_DATA: expected a folder with config/ inside, got \"{}\"", place.data));
  for (const auto& root : DeploymentRoots(place))
    if (!given.empty() && fs::is_directory(root / given)) return root / given;
  RefuseDeployment(given, place);
}

std::string LogFolder(const ProgramPlace& place) {
  if (!place.logs.empty()) return place.logs;
  if (!place.clone.empty()) return place.clone / "logs";
  const fs::path state = XdgFolder(place.state_home, place.home, ".local/state");
  if (state.empty())
    throw ConfigError("logs: expected a folder, got neither --logs nor $PRIAMOS_LOGS nor $HOME");
  return state / "priamos";
}

std::string ShownFrom(const fs::path& folder, const fs::path& path) {
  const fs::path relative = path.lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? path.string() : relative.string();
}

}  // namespace priamos
