#pragma once

#include <cstddef>
#include <cstdint>

#include "bus/radio/link.hpp"
#include "common/time.hpp"
#include "priamos/link_status_t.hpp"

namespace priamos::radio {

/// State that one report keeps for the next.
struct ReportState {
  std::uint64_t bytes_sent = 0;      ///< count at the last report, for the utilisation
  std::uint64_t bytes_received = 0;  ///< count at the last report
  std::uint64_t turned_away = 0;     ///< datagrams and connections that the port did not even read
  std::size_t first_channel = 0;     ///< where the next report begins if not all channels fit one
};

/// The state of one end as a message. `elapsed` is the time since the report before; `undecodable`: messages
/// that arrived and were none of their type.
link_status_t ToMessage(const bus::radio::LinkEndpoint& link, double bytes_per_s, std::uint64_t undecodable,
                        Duration elapsed, Time now, ReportState& state);

}  // namespace priamos::radio
