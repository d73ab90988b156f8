#pragma once

#include <string>

#include "cli/verbs/help/host_probe.hpp"

namespace priamos::cli {

/// Throws bus::BusError for a bus that is on one host only.
void RequireHosts(const std::string& url);

/// Asks on the UDP multicast bus at `url` for `seconds`, five times in two of them, and answers those who ask
/// meanwhile. Returns half a second after the last question. Throws BusError.
HostProbe ProbeBus(const std::string& url, double seconds);

}  // namespace priamos::cli
