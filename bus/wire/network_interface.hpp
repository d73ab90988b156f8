#pragma once

#include <string>
#include <vector>

namespace priamos::bus {

/// One network interface of this host, as the kernel describes it to the network namespace of this process.
struct NetworkInterface {
  unsigned index = 0;
  std::string name;                    ///< "eth1"
  std::vector<std::string> addresses;  ///< IPv4, "10.77.0.1"; the first is the one it sends from
  bool up = false;
  bool carrier = false;  ///< a cable, or a radio cell
  bool multicast = false;
  bool loopback = false;
};

/// All of them, in the kernel's order.
std::vector<NetworkInterface> NetworkInterfaces();

/// The interface with this name or IPv4 address. Throws BusError that names those there are.
NetworkInterface FindInterface(const std::string& name_or_address);

/// Name of the interface by which this host sends to the IPv4 address `to` (which may be multicast) when it
/// is told none; empty when there is no route.
std::string InterfaceOfRoute(const std::string& to);

}  // namespace priamos::bus
