#pragma once

#include <cstdint>
#include <string>

namespace priamos::bus {

/// UDP port of a `udpm://address:port?...` URL; LCM's default 7667 when it names none.
std::uint16_t PortOf(const std::string& url);

/// Attaches a BPF filter to liblcm's receive sockets on `port` that passes only datagrams beginning with
/// `LC02` (unfragmented messages).
///
/// Two crafted fragments with an offset near 2^32 kill any subscriber of LCM 1.3.1 inside its receive
/// thread, before a handler sees a byte. Parametric messages never fragment, so nothing is lost. liblcm does
/// not hand out its socket: it is found among this process's own descriptors. Returns the number of sockets
/// filtered; throws std::runtime_error when the kernel refuses the filter.
int FilterFragments(std::uint16_t port);

}  // namespace priamos::bus
