#pragma once

#include <set>
#include <string>
#include <vector>

#include "bus/node.hpp"
#include "cli/scenario/scenario.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// Which processes of a scenario have been heard of on their bus. spacenavd sends on none and is not waited
/// for.
class AliveProcesses {
 public:
  AliveProcesses(const Scenario& scenario, bus::Node& onboard, bus::Node& offboard);

  /// Takes the HEALTH messages that came since the last call.
  void Listen();
  /// Those not heard of yet, "onboard robot, offboard planner"; empty when all are alive.
  std::string Missing() const;

 private:
  std::vector<std::string> expected_;  ///< "BUS MODULE", in the scenario's order
  bus::Inbox<health_t> onboard_, offboard_;
  std::set<std::string> alive_;
};

}  // namespace priamos::cli
