#pragma once

#include <string>
#include <vector>

#include "cli/scenario.hpp"
#include "cli/supervisor.hpp"

namespace priamos::cli {

/// config/<deployment>/deployment.toml: the processes of a robot, for `priamos up`.
struct Deployment {
  std::string title;
  std::string onboard_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string offboard_url = "udpm://239.255.76.68:7668?ttl=0";
  std::string group = "all";   ///< which ones `priamos up` starts: onboard, offboard or all
  bool emulated_line = false;  ///< a serial line out of nothing between the radios
  bus::radio::LineConfig line;
  std::vector<ScenarioProcess> processes;

  void Describe(Archive& a) {
    a.Text("title", title, "what runs, in a few words");
    a.Text("onboard_url", onboard_url, "LCM bus of the robot");
    a.Text("offboard_url", offboard_url, "LCM bus of the workstation");
    a.Choice("group", group, {"all", "onboard", "offboard"}, "what runs on this machine");
    a.Flag("emulated_line", emulated_line, "join the two radios by an emulated serial line");
    a.Section("line", line, "that line");
    a.List("process", processes, "the processes");
  }
};

/// What a plan needs besides the processes themselves.
struct LaunchPlace {
  std::string program_folder;  ///< where priamos-* are
  std::string config_folder;   ///< of the deployment
  std::string run_folder;      ///< absolute; ttys and consoles
  std::uint64_t seed = 1;
};

/// The processes of a deployment with their command lines, the emulated line and the emulated mouse among
/// them. Processes of the same module on the same bus get names of their own.
std::vector<ProcessSpec> PlanOf(const Deployment& deployment, const LaunchPlace& place);

/// Where the emulated mouse of `place` is plugged in, and where its daemon answers.
std::string MouseTty(const LaunchPlace& place);
std::string MouseSocket(const LaunchPlace& place);

}  // namespace priamos::cli
