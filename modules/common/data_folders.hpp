#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace priamos {

/// Paths and variables that determine where deployments, shared files and logs are. The functions below
/// depend on these and on the disk only. An empty one is not set.
struct ProgramPlace {
  std::filesystem::path program_folder;  ///< where the running program is, absolute
  std::filesystem::path clone;           ///< the clone of the repository whose build folder it runs from
  std::string data;                      ///< $PRIAMOS_DATA: a folder like `<prefix>/share/priamos`
  std::string logs;                      ///< $PRIAMOS_LOGS: where runs are written
  std::string home;                      ///< $HOME
  std::string config_home;               ///< $XDG_CONFIG_HOME
  std::string config_dirs;               ///< $XDG_CONFIG_DIRS, with colons between
  std::string state_home;                ///< $XDG_STATE_HOME
};

/// The place of this process, from /proc/self/exe and its environment.
ProgramPlace ThisProgram();

/// Where configuration of a machine belongs when the program is installed at `prefix`: /etc for /usr, else a
/// folder of the prefix. config/install does the same.
std::filesystem::path SystemConfigFolder(const std::filesystem::path& prefix);

/// The folders that hold a folder per deployment, the first that has one wins: $PRIAMOS_DATA, those of the
/// user and of the machine by the XDG rules, then config/ of the clone, or what was installed.
std::vector<std::filesystem::path> DeploymentRoots(const ProgramPlace& place);

/// Every deployment that has a name there, sorted.
std::vector<std::string> KnownDeployments(const ProgramPlace& place);

/// The folder of the deployment `given`: a path (it has a slash) as it is, a name in the first root that has
/// it. Throws ConfigError that names the known ones and the places searched.
std::string FindDeployment(const std::string& given, const ProgramPlace& place);

/// Where runs are written by default: $PRIAMOS_LOGS; logs/ of the clone; else
/// $XDG_STATE_HOME/priamos, without it
/// ~/.local/state/priamos. Throws ConfigError without a home.
std::string LogFolder(const ProgramPlace& place);

/// Path `path` as a person in `folder` would type it: relative when it is below, else as it is.
std::string ShownFrom(const std::filesystem::path& folder, const std::filesystem::path& path);

}  // namespace priamos
