#pragma once

#include <cstdint>
#include <string>

namespace priamos::bus {

/// Multicast address of a `udpm://address:port?...` URL; LCM's default when it names none.
std::string GroupOf(const std::string& url);
/// UDP port of such a URL; LCM's default 7667 when it names none.
std::uint16_t PortOf(const std::string& url);

/// Checks the route for multicast. Throws BusError, with the command that mends it, when this machine has no
/// route for the multicast group of a `udpm://` URL. liblcm would answer the same with twenty lines and a
/// garbled address.
void RequireMulticastRoute(const std::string& url);

}  // namespace priamos::bus
