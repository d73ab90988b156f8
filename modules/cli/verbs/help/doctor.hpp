#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bus/wire/network_interface.hpp"

namespace priamos::cli {

/// One thing PRIAMOS needs of a machine, as it was found.
struct Finding {
  /// Result of one check; kNotNeededYet: missing, and only some verbs need it.
  enum class Verdict { kGood, kNotNeededYet, kBad };
  std::string what;  ///< "multicast route"
  Verdict verdict = Verdict::kGood;
  std::string found;    ///< "224.0.0.0/4 leads to lo"
  std::string command;  ///< command that repairs it; empty if nothing is wrong
};

/// How the clock of this host's processes stands to the wall clock.
struct ClockState {
  double wall_ahead_s = 0;
  std::string file;     ///< where the processes agree on it; empty: each has its own
  std::string problem;  ///< why
};

/// The machine the doctor looks at, so that a test can bring another one.
struct Machine {
  std::filesystem::path root = "/";  ///< where /proc, /sys, /dev, /etc and /run are
  std::filesystem::path disk = ".";  ///< where runs are written; it need not be there yet
  std::function<std::string(const std::string& bus)> route_problem;  ///< empty: there is one
  std::function<bool()> loopback_has_multicast;
  std::function<bool(const std::string& program)> has_program;
  std::function<bool()> clock_synchronised;
  std::function<std::vector<bus::NetworkInterface>()> interfaces;
  /// Name of the interface to which the route for a multicast group leads; empty: there is no route.
  std::function<std::string(const std::string& group)> route_interface;
  std::function<ClockState()> host_clock;
  std::function<bool(const std::filesystem::path&)> may_write;
};

/// Machine on which the program runs.
Machine ThisMachine();

/// Results of all checks, in the order in which a person would mend them. `other_hosts`: the bus at the URL
/// `bus` is to reach other computers, so that what keeps it on this one is bad.
std::vector<Finding> Examine(const Machine& machine, const std::string& bus, bool other_hosts);

}  // namespace priamos::cli
