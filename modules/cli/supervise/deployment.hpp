#pragma once

#include <string>
#include <vector>

#include "bus/wire/bus_address.hpp"
#include "bus/wire/multicast.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/supervise/supervisor.hpp"

namespace priamos::cli {

/// Contents of `config/<deployment>/deployment.toml`: the processes of a robot, for `priamos up`.
struct Deployment {
  std::string title;
  std::string robot{bus::kDefaultRobot};  ///< groups and ports of its buses follow from its name
  int onboard_ttl = 0, offboard_ttl = 0;
  std::string onboard_network, offboard_network;  ///< interface or its address; empty: as the route leads
  std::string group = "all";   ///< which ones `priamos up` starts: onboard, offboard or all
  std::string host;            ///< which ones of those: the host's name, not of the file; empty: every host's
  std::string scenarios;       ///< worlds in which a simulated robot can be; it begins in the first
  bool emulated_line = false;  ///< join the radios by an emulated serial line
  bus::radio::LineConfig line;
  std::vector<ScenarioProcess> processes;

  std::string OnboardUrl() const {
    return bus::WithNetwork(bus::BusUrl(robot, bus::BusSide::kOnboard, onboard_ttl), onboard_network);
  }
  std::string OffboardUrl() const {
    return bus::WithNetwork(bus::BusUrl(robot, bus::BusSide::kOffboard, offboard_ttl), offboard_network);
  }

  void Describe(Archive& a) {
    a.Text("title", title, "what runs, in a few words");
    a.Text("robot", robot,
           "name of the robot: a-z, 0-9 and \"-\"; groups and ports of its buses follow from it");
    a.Integer("onboard_ttl", onboard_ttl,
              {"", 0, 255, "routers a message on the robot's bus may pass; 0: this host"});
    a.Integer("offboard_ttl", offboard_ttl, {"", 0, 255, "TTL of datagrams on the workstation's bus"});
    a.Text("onboard_network", onboard_network,
           "interface (eth1) or its address for the robot's bus; empty: as the route for multicast leads");
    a.Text("offboard_network", offboard_network, "the same for the workstation's bus");
    a.Choice("group", group, {"all", "onboard", "offboard"}, "what runs on this machine");
    a.Flag("emulated_line", emulated_line, "join the two radios by an emulated serial line");
    a.Text("scenarios", scenarios,
           "scenarios, with commas between them, in whose world a simulated robot can be: it begins in the "
           "first, and the station offers all; empty: the world is as the files have it");
    if (!scenarios.empty() && !emulated_line) a.Refuse("scenarios", "none without emulated_line");
    a.Section("line", line, "that line");
    a.List("process", processes, "the processes");
  }
};

/// The hosts that a deployment names, sorted; empty when it is for one host.
std::vector<std::string> HostsOf(const Deployment& deployment);

/// Checks that the chosen host is one of the deployment's. Throws ConfigError that names those there are.
void RequireHost(const Deployment& deployment);

/// Whether `process` belongs to the chosen group and host.
bool StartsHere(const Deployment& deployment, const ScenarioProcess& process);

/// Folders and seed of a plan of processes.
struct LaunchPlace {
  std::string program_folder;  ///< where priamos-* are
  std::string config_folder;   ///< where the deployment's configuration files are
  std::string run_folder;      ///< absolute; ttys and consoles
  std::uint64_t seed = 1;
};

/// The processes of a deployment with their command lines, the emulated line and the emulated mouse among
/// them. Processes of the same module on the same bus get names of their own.
std::vector<ProcessSpec> PlanOf(const Deployment& deployment, const LaunchPlace& place);

/// The words of a list with commas between them.
std::vector<std::string> WordsOfList(const std::string& list);

/// Files in which the processes of `place` keep what they learned of a simulated world.
std::vector<std::string> LearnedFiles(const LaunchPlace& place);

/// Where the emulated mouse of `place` is plugged in, and where its daemon answers.
std::string MouseTty(const LaunchPlace& place);
std::string MouseSocket(const LaunchPlace& place);

}  // namespace priamos::cli
