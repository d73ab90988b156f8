#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

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

/// The machine the doctor looks at, so that a test can bring another one.
struct Machine {
  std::filesystem::path root = "/";  ///< where /proc, /sys, /dev, /etc and /run are
  std::filesystem::path disk = ".";  ///< where runs are written; it need not be there yet
  std::function<std::string(const std::string& bus)> route_problem;  ///< empty: there is one
  std::function<bool()> loopback_has_multicast;
  std::function<bool(const std::string& program)> has_program;
  std::function<bool()> clock_synchronised;
  std::function<bool(const std::filesystem::path&)> may_write;
};

/// Machine on which the program runs.
Machine ThisMachine();

/// Results of all checks, in the order in which a person would mend them.
std::vector<Finding> Examine(const Machine& machine, const std::string& bus);

}  // namespace priamos::cli
