#pragma once

#include <cstdint>
#include <string>

namespace priamos::bus {

/// The address that every LCM program has when it was told none.
inline constexpr const char* kLcmDefaultGroup = "239.255.76.67";
inline constexpr std::uint16_t kLcmDefaultPort = 7667;

/// Multicast address of a `udpm://address:port?...` URL; LCM's default when it names none.
std::string GroupOf(const std::string& url);
/// UDP port of such a URL; LCM's default 7667 when it names none.
std::uint16_t PortOf(const std::string& url);
/// Routers a message may pass, `ttl` of such a URL; 0, this host alone, when it names none. Throws BusError
/// for anything but 0 to 255.
int TtlOf(const std::string& url);
/// Name or address of the network interface, `network` of such a URL; empty when it names none: then the
/// route for multicast decides.
std::string NetworkOf(const std::string& url);

/// By what messages of a bus leave this host; empty when there is no way, or it is no bus between hosts.
struct BusDeparture {
  std::string interface;  ///< "eth1"
  std::string address;    ///< IPv4 that the others see as their sender
};
BusDeparture DepartureOf(const std::string& url);

/// A `udpm://` URL that names `network`, unless it names one already or `network` is empty. Any other URL as
/// it is.
std::string WithNetwork(const std::string& url, const std::string& network);
/// URL without `network`, which LCM's own programs do not know.
std::string WithoutNetwork(const std::string& url);

/// Checks a `udpm://` URL. Throws BusError for an address that is not multicast, or a parameter that is not
/// ttl, network or LCM's recv_buf_size (which PRIAMOS does not need: it takes what the kernel gives).
void RequireMulticastUrl(const std::string& url);

/// Checks the way for multicast: an interface that is there and up if the URL names one, else a route. Throws
/// BusError, with the command that mends it. liblcm would answer a missing route with twenty lines and a
/// garbled address.
void RequireMulticastRoute(const std::string& url);

}  // namespace priamos::bus
