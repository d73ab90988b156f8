#pragma once

#include <string>
#include <vector>

#include "bus/app.hpp"
#include "bus/bus_choice.hpp"
#include "common/config.hpp"

namespace CLI {
class App;
}

namespace priamos::bus {

/// The options on the command line of a process.
struct ProcessOptions {
  ConfigSource config;
  BusChoice choice;
  std::string bus;                 ///< URL
  std::vector<std::string> typed;  ///< which of --bus, --robot, --ttl and --network were given
  std::uint64_t seed = 0;
  bool follows_log = false;  ///< `--clock bus`
  bool print_config = false;
  bool print_parameters = false;
  bool interface = false;
};

/// Adds the options of the process that `factory` starts to `cli`; parsing fills `options`.
void AddProcessOptions(CLI::App& cli, const AppFactory& factory, ProcessOptions& options);

/// Fills in what the command line and the environment left open: from `[bus]` of the configuration, else the
/// defaults of `factory`. Throws ConfigError, and BusError for a bus that is none.
void ChooseBus(const AppFactory& factory, ProcessOptions& options);

}  // namespace priamos::bus
