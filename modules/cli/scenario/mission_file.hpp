#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/config.hpp"
#include "common/input/section_place.hpp"
#include "planner/planner_config.hpp"
#include "priamos/mission_command_t.hpp"

namespace priamos::cli {

/// One step of a mission file.
struct MissionFileStep {
  std::string what = "goto";  ///< "goto", "door", "elevator", "corridor", "locate", "wait" or "repeat"
  double x_m = 0, y_m = 0;
  std::optional<double> yaw_deg;  ///< heading at the place; as it suits the path if not given
  std::string door;               ///< name or number
  double distance_m = 0;          ///< along a corridor; 0: to its end
  double wait_s = 0;
  bool turn = false;        ///< elevator: turn round in the cabin
  int from = 1, times = 1;  ///< repeat: the steps from this one on, so many times more
  SectionPlace place;       ///< where it was read, for errors

  void Describe(Archive& a);
};

/// What the planner is to do, written down: `priamos mission run FILE`.
struct MissionFile {
  std::string title;
  int rounds = 1;  ///< 0: until it is cancelled
  std::vector<MissionFileStep> steps;

  void Describe(Archive& a);
};

/// The order that the file gives to the planner that has the configuration `planner`. Everything that can be
/// known beforehand is checked against its map: doors by name, places that the base fits, ways between them.
/// Throws ConfigError: file, line, what is wrong.
mission_command_t OrderOfFile(const std::string& file, const ConfigSource& planner);

/// The same of steps that stand in no file, or in one that is read already.
mission_command_t OrderOf(const MissionFile& file, const ConfigSource& planner);

/// The same of a file that is read already, with the planner's configuration and plan.
mission_command_t OrderOf(const MissionFile& file, const planner::PlannerConfig& config,
                          const GroundPlan& plan, const std::string& map);

}  // namespace priamos::cli
