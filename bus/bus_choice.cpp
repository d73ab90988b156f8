#include "bus/bus_choice.hpp"

#include <CLI/CLI.hpp>

namespace priamos::bus {

void AddBusChoice(CLI::App& cli, BusChoice& choice) {
  cli.add_option("--bus", choice.bus, "LCM bus: onboard, offboard or an LCM URL")
      ->envname(kBusVariable)
      ->capture_default_str();
  cli.add_option("--robot", choice.robot, "name of the robot; the ports of its buses follow from it")
      ->envname(kRobotVariable)
      ->capture_default_str();
  cli.add_option("--ttl", choice.ttl, "routers a message may pass on a named bus; 0 stays on this host")
      ->envname(kTtlVariable)
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
}

}  // namespace priamos::bus
