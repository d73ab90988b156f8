#pragma once

#include <string>

namespace priamos::bus {

/// Throws BusError, with the command that mends it, when this machine has no route for the multicast group of
/// a `udpm://` URL. liblcm would answer the same with twenty lines and a garbled address.
void RequireMulticastRoute(const std::string& url);

}  // namespace priamos::bus
