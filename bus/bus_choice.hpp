#pragma once

#include <string>

#include "bus/wire/bus_address.hpp"

namespace CLI {
class App;
}

namespace priamos::bus {

/// Which bus a command line means: `--bus`, `--robot` and `--ttl`, or the environment variables behind them.
struct BusChoice {
  std::string bus = "offboard";      ///< onboard, offboard or an LCM URL
  std::string robot{kDefaultRobot};  ///< for a named bus
  int ttl = 0;                       ///< for a named bus: routers a message may pass; 0 stays on this host

  /// LCM URL of the chosen bus. Throws BusError for a name or a ttl that ResolveBus refuses.
  std::string Url() const { return ResolveBus(bus, robot, ttl); }
};

/// Adds the three options to a program or a verb; the values in `choice` are the defaults. `choice` must
/// outlive `cli`.
void AddBusChoice(CLI::App& cli, BusChoice& choice);

}  // namespace priamos::bus
