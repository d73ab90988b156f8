#pragma once

#include <cstddef>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/link_options.hpp"

/// How long the frames of a direction may be.
namespace priamos::bus::radio {

/// Longest frames of an end.
struct FrameLength {
  std::size_t bundle_bytes = 0;  ///< of a bundle of several messages
  bool strict = false;           ///< no frame is longer; else a longer message goes alone
};

/// Where ends take turns of one frame, frames have `max_bundle_bytes`, strictly.
///
/// In a direction with commands every command is to go before the next one comes, because the newer one
/// replaces the one that waits: a frame lasts no longer than the time between two commands of the most
/// frequent channel, strictly. Not where such a frame would have no room for a command and the longest entry
/// of a message beside it; nor where longer turns, or packets, decide when a command goes.
///
/// Elsewhere frames have `max_bundle_bytes`.
FrameLength FrameLengthOf(const ChannelTable& table, const LinkOptions& options, Direction direction);

}  // namespace priamos::bus::radio
