#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/scenario/mission_order.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/json_line.hpp"
#include "common/config.hpp"
#include "priamos/mission_command_t.hpp"
#include "priamos/mission_status_t.hpp"

namespace priamos::cli {

/// Exit code of a mission that was not carried out.
inline constexpr int kMissionNotDone = 1;

/// What a verb of `priamos mission` was given.
struct MissionOptions {
  BusOptions bus;
  std::string door, file;
  double x_m = 0, y_m = 0;
  std::optional<double> yaw_deg;
  double distance_m = 0;       ///< along a corridor; 0: to its end
  std::vector<double> places;  ///< x and y in turn
  double wait_s = 0;           ///< in an elevator
  bool turn = false;           ///< round in its cabin
  int order = 0;
  std::string deployment, log_root;  ///< of the planner; empty: as PlannerInUse has it, and LogRoot
  bool wait = false, json = false;
};

/// Gives the order and follows it as long as it is open: words for a person, with --json one line per step
/// that has ended and one for the order. Returns the exit code.
int GiveOrder(const MissionOptions& options, const mission_command_t& command, const char* verb);

/// The configuration of the planner whose map tells the places and doors of an order.
ConfigSource PlannerOf(const MissionOptions& options);
/// The options that it depends on.
void AddPlannerOptions(CLI::App& verb, MissionOptions& options);

/// The options that every verb of a mission has.
void CompleteMission(CLI::App& verb, const std::shared_ptr<MissionOptions>& options,
                     int (*run)(const MissionOptions&), int& exit_code);

/// An outcome of mission_result_t: "done", "failed", "cancelled", "refused".
std::string_view ResultName(int outcome);
/// ", step 2 of 5, round 3, 40 s left, paused", as far as there is something to say.
std::string ProgressText(const mission_status_t& status);
/// A status as members of a JSON object.
std::vector<std::pair<std::string, JsonScalar>> StatusMembers(const mission_status_t& status);

/// The verbs of the queue: run, patrol, elevator, list, cancel, pause, resume.
void AddQueueVerbs(CLI::App& mission, int& exit_code);

}  // namespace priamos::cli
