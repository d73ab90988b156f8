#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "bus/schema/schema.hpp"
#include "cli/report/report_summary.hpp"
#include "cli/report/run_recorder.hpp"
#include "cli/scenario/scenario.hpp"

namespace priamos::cli {

/// Which scenario to run, from which seed, and who follows it.
struct LockstepRequest {
  std::string deployment;  ///< its folder
  std::string scenario = "door";
  std::uint64_t seed = 1;
  std::optional<std::string> log_folder;  ///< none: nothing is written
  bool keep_pictures = false;             ///< those that the head uses, in `pictures` in log_folder
  std::function<void(Time, const std::string&)> progress;  ///< simulated time since the start
  std::function<void(std::string_view bus, Time, std::string_view channel, std::span<const std::byte>)> tap;
  std::function<bool()> interrupted = [] { return false; };  ///< asked all the time; true ends the run
};

/// Somebody ended the run from outside: it has no result.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("stopped by a signal") {}
};

/// Result of a scenario; `duration` in simulated time.
struct LockstepResult {
  Summary summary;
  RunRecord record;
  RunInfo info;
  std::string map_file;
  Duration duration{};
};

/// One scenario in lockstep. Throws ConfigError, Interrupted and what the Apps' start throws.
LockstepResult RunLockstep(const bus::Schema& schema, const LockstepRequest& request);

}  // namespace priamos::cli
