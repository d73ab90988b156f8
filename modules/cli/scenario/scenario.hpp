#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "bus/radio/line/line.hpp"
#include "common/archive.hpp"

namespace priamos::cli {

/// Longest name of a host in a deployment: the role of its supervisor has room for so much.
inline constexpr std::size_t kLongestHostName = 13;

/// Whether a deployment may call a host so: a-z, 0-9 and "-".
bool IsHostName(std::string_view name);

/// One process of a scenario or a deployment.
struct ScenarioProcess {
  std::string module;  ///< folder of the program; spacenavd: the daemon, with an emulated mouse
  std::string bus;     ///< onboard or offboard
  std::string config;  ///< its configuration, relative to the deployment's folder
  std::string set;     ///< KEY=VALUE on top of it, may be empty
  std::string after;   ///< processes that must be ready before, e.g. "onboard-world, line"
  double watchdog_s = 1.0;
  std::string host;  ///< of a deployment over several hosts; empty: every one

  void Describe(Archive& a) {
    a.Choice("module", module,
             {"world", "robot", "head", "planner", "teleop", "console", "radio", "spacenavd"},
             "which program");
    a.Choice("bus", bus, {"onboard", "offboard"}, "the LCM bus it lives on");
    a.Text("config", config, "its configuration file, relative to the deployment's folder");
    a.Text("set", set, "KEY=VALUE on top of that file");
    a.Text("after", after, "processes that must be ready before, BUS-MODULE, with commas between them");
    a.Number("watchdog_s", watchdog_s, {"s", 0.5, 60, "a process that is silent for so long hangs"});
    a.Text("host", host, "the host on which `priamos up --host` starts it; empty: on every one");
    if (!host.empty() && !IsHostName(host))
      a.Refuse("host", fmt::format("a name of 1 to {} of a-z, 0-9 and \"-\"", kLongestHostName));
  }
};

/// A place to drive to by hand.
struct ScenarioWaypoint {
  double x_m = 0, y_m = 0, yaw_deg = 0;

  void Describe(Archive& a) {
    a.Number("x_m", x_m, {"m", -100, 100, "map frame"});
    a.Require("x_m", "a place on the map in m");
    a.Number("y_m", y_m, {"m", -100, 100, "map frame"});
    a.Require("y_m", "a place on the map in m");
    a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "heading on the drive there"});
  }
};

/// The processes and the task of a run: the same file for `priamos run` (real time) and `priamos lockstep`.
struct Scenario {
  std::string title;
  std::string story = "door";  ///< name in Stories()
  int landmark_id = 1;
  double time_limit_s = 120;
  std::string map;
  bus::radio::LineConfig line;
  std::vector<ScenarioProcess> processes;
  std::vector<ScenarioWaypoint> waypoints;  ///< where the operator drives; none: he shakes the stick
  bool fast = false;                        ///< he uses the fast range
  double shake_s = 60;
  double astray_deg = 0;      ///< error of the direction in which he pushes, one sigma; 0: exact
  double longest_stop_s = 0;  ///< longest stop of the base in the passage; 0: any
  double least_seen = 0.98;   ///< share of the reachable floor that an exploration has to see; 0: any

  void Describe(Archive& a);
};

/// Where the scenario's serial line ends, by the radios' names for it.
inline constexpr std::string_view kMouseTty = "tty-mouse", kHandTty = "tty-hand";
inline constexpr std::string_view kOnboardTty = "tty-onboard";
inline constexpr std::string_view kOffboardTty = "tty-offboard";

/// The scenario `name` of the deployment in `folder` (config/sim). Throws ConfigError; an unknown name is
/// answered with the known ones.
Scenario LoadScenario(const std::string& folder, const std::string& name);

/// The map file of `scenario`.
std::string MapFile(const std::string& folder, const Scenario& scenario);

/// Why a run failed that its time limit ended. `doing`: what was under way, in the planner's words; empty
/// before it has said anything.
std::string TimeLimitReason(const Scenario& scenario, const std::string& doing);

}  // namespace priamos::cli
