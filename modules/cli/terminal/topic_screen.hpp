#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/wire/lcm_bus.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/terminal/topic_statistics.hpp"

namespace priamos::cli {

/// What a bus lost.
struct BusLosses {
  std::vector<bus::SenderCounters> senders;
  std::uint64_t lost = 0, malformed = 0, turned_away = 0;  ///< datagrams
};

/// The table of `priamos topic list`: the channels, then who sends and what was lost. With a size it fits:
/// first columns go, then senders, then channels, which are counted; header and losses stay.
std::string TopicScreen(const std::vector<TopicRow>& rows, const BusLosses& losses,
                        std::optional<ScreenSize> size);

}  // namespace priamos::cli
