#pragma once

#include <sys/types.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/supervise/supervisor.hpp"
#include "cli/terminal/text_table.hpp"

namespace priamos::cli {

/// What `priamos up` leaves in the log folder for `status`, `logs` and `down`: who runs, and how it is. One
/// `up` per folder: a lock shows whether one runs, so a dead one is never taken for alive.
class UpLock {
 public:
  /// Takes the lock of the log folder `log_root`. Throws std::runtime_error with one sentence when another
  /// `up` has the folder, or it cannot be written.
  explicit UpLock(const std::string& log_root);
  ~UpLock();
  UpLock(const UpLock&) = delete;
  UpLock& operator=(const UpLock&) = delete;

  /// The `up` that holds the folder; nullopt when none does.
  static std::optional<pid_t> Holder(const std::string& log_root);
  /// The folder that process `pid` of this computer holds; nullopt when it holds none, or belongs to another
  /// user.
  static std::optional<std::string> FolderOf(pid_t pid);

 private:
  std::string file_;
  int fd_ = -1;
};

/// The contents of up.json.
struct UpState {
  std::string deployment;
  std::string config_folder;  ///< of its configuration
  std::string planner_set;    ///< what its scenario sets of the planner, as `--set`; empty: nothing
  std::string folder;         ///< consoles
  bool ready = false;
  double up_s = 0;
  std::vector<ProcessReport> processes;
  std::vector<double> ages_s;       ///< how long each is in its state
  std::vector<std::string> alarms;  ///< heard on the buses, newest last
};

/// State in the form in which up.json holds it.
nlohmann::ordered_json ToJson(const UpState& state);

/// Replaces the up.json of a log folder. Returns false with errno set when it failed.
bool WriteUpState(const std::string& log_root, const UpState& state);
/// State in the up.json of a log folder; nullopt when there is none that can be read.
std::optional<UpState> ReadUpState(const std::string& log_root);
/// The table of `priamos status`, and below it why processes last ended. With a size, lines fit its width.
std::string FormatUpState(const UpState& state, std::optional<ScreenSize> size);

}  // namespace priamos::cli
