#pragma once

#include <string>

namespace CLI {
class App;
}

namespace priamos::cli {

/// Adds the option `--deployment`, by default sim. What it names is found by FolderOfDeployment, once the
/// verb runs.
void AddDeploymentOption(CLI::App& verb, std::string& deployment);
/// Adds the option `--deployment` of a verb that asks what is up; left out it stays empty.
void AddLiveDeploymentOption(CLI::App& verb, std::string& deployment);
/// Folder of the configuration of `deployment`. Throws ConfigError when it is not found.
std::string FolderOfDeployment(const std::string& deployment);

/// Adds the option `--logs`; `what` names what is written there. Left out it stays empty, and LogRoot gives
/// the default.
void AddLogsOption(CLI::App& verb, std::string& log_root, const std::string& what);
/// Folder for logs: `log_root`, or the default one when that is empty. Throws ConfigError when there is no
/// default.
std::string LogRoot(const std::string& log_root);
/// Name for what begins now, by local time: "20260412-153000". Names sort as the times do.
std::string NameByTime();
/// Makes the folder of a run, "20260412-153000-<what>", in the folder for logs `log_root`. Returns its
/// absolute path.
std::string MakeRunFolder(const std::string& log_root, const std::string& what);

}  // namespace priamos::cli
