#pragma once

#include <optional>

#include "bus/clocks/clock_offset.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

/// Writes into `message` how far the clock of this host is ahead of the reference of the bus
/// (PeerClocks::AheadOfReference); nullopt, and what is known to less than a second: not known.
void SetClock(health_t& message, const std::optional<ClockDifference>& ahead);

}  // namespace priamos::bus
