#include "bus/bus_choice.hpp"

#include <CLI/CLI.hpp>

#include "bus/wire/multicast.hpp"
#include "common/archive.hpp"

namespace priamos::bus {

std::string BusChoice::Url() const {
  return WithNetwork(ResolveBus(bus, robot, ttl), network);
}

void BusChoice::Describe(Archive& a) {
  a.Text("name", bus, "onboard, offboard or an LCM URL; $PRIAMOS_BUS and --bus win");
  a.Text("robot", robot, "a-z, 0-9 and \"-\"; group and port of a named bus follow from it; --robot wins");
  a.Integer("ttl", ttl,
            {"-", 0, 255, "routers a message may pass on a named bus; 0 stays on this host; --ttl wins"});
  a.Text("network", network,
         "interface (eth1) or its address by which it is sent and heard; empty: as the route leads; "
         "--network wins");
}

void AddBusChoice(CLI::App& cli, BusChoice& choice) {
  cli.add_option("--bus", choice.bus, "LCM bus: onboard, offboard or an LCM URL")
      ->envname(kBusVariable)
      ->capture_default_str();
  cli.add_option("--robot", choice.robot, "name of the robot; group and port of its buses follow from it")
      ->envname(kRobotVariable)
      ->capture_default_str();
  cli.add_option("--ttl", choice.ttl, "routers a message may pass on a named bus; 0 stays on this host")
      ->envname(kTtlVariable)
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  cli.add_option(
         "--network", choice.network,
         "interface (eth1) or its address, by which the bus is sent and heard; none: as the route for "
         "multicast leads")
      ->envname(kNetworkVariable);
}

}  // namespace priamos::bus
