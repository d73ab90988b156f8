#pragma once

#include "bus/radio/link.hpp"
#include "common/time.hpp"
#include "priamos/link_status_t.hpp"

namespace priamos::radio {

/// The state of one end as a message. `bytes_before` and `elapsed` are since the report before, for the
/// utilisation.
link_status_t ToMessage(const bus::radio::LinkEndpoint& link, double bytes_per_s, std::uint64_t bytes_before,
                        Duration elapsed, Time now);

}  // namespace priamos::radio
