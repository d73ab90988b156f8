#include "cli/scenario/alive_processes.hpp"

namespace priamos::cli {

AliveProcesses::AliveProcesses(const Scenario& scenario, bus::Node& onboard, bus::Node& offboard)
    : onboard_(onboard.SubscribeAll(channels::kHealth)), offboard_(offboard.SubscribeAll(channels::kHealth)) {
  for (const auto& process : scenario.processes)
    if (process.module != "spacenavd") expected_.push_back(process.bus + " " + process.module);
}

void AliveProcesses::Listen() {
  // The two radios name their sides themselves.
  const auto hear = [&](const std::string& bus, const std::string& process) {
    alive_.insert(bus + " " + (process.starts_with(bus + "-") ? process.substr(bus.size() + 1) : process));
  };
  for (const auto& m : onboard_.Drain()) hear("onboard", m.process);
  for (const auto& m : offboard_.Drain()) hear("offboard", m.process);
}

std::string AliveProcesses::Missing() const {
  std::string missing;
  for (const auto& name : expected_)
    if (!alive_.contains(name)) missing += (missing.empty() ? "" : ", ") + name;
  return missing;
}

}  // namespace priamos::cli
