#pragma once

#include <string>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/line/polling.hpp"
#include "bus/radio/link_options.hpp"

/// What the channel that several robots share can promise.
namespace priamos::bus::radio {

/// Times of the channel: the robots' longest frame is that of the table.
SharedChannel SharedChannelOf(const ChannelTable& table, const LinkOptions& options);

/// Worst cases of turns and emergency stops, on a line without bit errors.
PollBounds PollBoundsOf(const ChannelTable& table, const LinkOptions& options);

/// Why these channels cannot be used on a shared channel, one sentence each.
std::vector<std::string> SharedProblems(const ChannelTable& table, const LinkOptions& options);

/// The lines that `priamos link budget` adds for a shared channel.
std::string FormatPollBounds(const PollBounds& bounds, int robots);

}  // namespace priamos::bus::radio
