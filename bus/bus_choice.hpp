#pragma once

#include <string>

#include "bus/wire/bus_address.hpp"

namespace CLI {
class App;
}

namespace priamos {
class Archive;
}

namespace priamos::bus {

/// Which bus a command line means: `--bus`, `--robot`, `--ttl` and `--network`, or the environment variables
/// behind them.
struct BusChoice {
  std::string bus = "offboard";      ///< onboard, offboard or an LCM URL
  std::string robot{kDefaultRobot};  ///< for a named bus
  int ttl = 0;                       ///< for a named bus: routers a message may pass; 0 stays on this host
  /// Interface, or its address, by which the bus is sent and heard; empty: as the route for multicast leads.
  /// A URL that names one keeps its own.
  std::string network;

  /// Whether it is a robot's bus, not any LCM URL.
  bool IsNamed() const { return bus == "onboard" || bus == "offboard"; }
  /// LCM URL of the chosen bus. Throws BusError for a name or a ttl that ResolveBus refuses.
  std::string Url() const;
  /// As a section of a configuration.
  void Describe(Archive& a);
};

/// Adds the four options to a program or a verb; the values in `choice` are the defaults. `choice` must
/// outlive `cli`.
void AddBusChoice(CLI::App& cli, BusChoice& choice);

}  // namespace priamos::bus
