#pragma once

#include <string>
#include <vector>

#include "bus/radio/line.hpp"
#include "common/config.hpp"

namespace priamos::cli {

/// One process of a scenario.
struct ScenarioProcess {
  std::string module;  ///< world, robot, head, planner or radio
  std::string bus;     ///< onboard or offboard
  std::string config;  ///< its configuration, relative to the deployment's folder
  std::string set;     ///< KEY=VALUE on top of it, may be empty

  void Describe(Archive& a) {
    a.Choice("module", module, {"world", "robot", "head", "planner", "radio"}, "which program");
    a.Choice("bus", bus, {"onboard", "offboard"}, "the LCM bus it lives on");
    a.Text("config", config, "its configuration file, relative to the deployment's folder");
    a.Text("set", set, "KEY=VALUE on top of that file");
  }
};

/// What runs, and what for: the same file for `priamos run` (real time) and `priamos lockstep`.
struct Scenario {
  std::string title;
  int landmark_id = 1;
  double time_limit_s = 120;
  std::string map;
  bus::radio::LineConfig line;
  std::vector<ScenarioProcess> processes;

  void Describe(Archive& a) {
    a.Text("title", title, "what happens, in a few words");
    a.Integer("landmark_id", landmark_id, {"-", 0, 999, "the door of the map to pass"});
    a.Number("time_limit_s", time_limit_s, {"s", 1, 3600, "the run is ended after that"});
    a.Text("map", map, "ground plan drawn in the report, relative to the deployment's folder");
    a.Section("line", line, "the serial line between the two radios");
    a.List("process", processes, "the processes, in order of start");
  }
};

/// Where the scenario's serial line ends, by the radios' names for it.
inline constexpr std::string_view kOnboardTty = "tty-onboard";
inline constexpr std::string_view kOffboardTty = "tty-offboard";

/// The scenario `name` of the deployment in `folder` (config/sim). Throws ConfigError; an unknown name is
/// answered with the known ones.
Scenario LoadScenario(const std::string& folder, const std::string& name);

/// The map file of `scenario`.
std::string MapFile(const std::string& folder, const Scenario& scenario);

}  // namespace priamos::cli
