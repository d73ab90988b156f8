#pragma once

#include <cstddef>

#include "bus/radio/channels/channel_table.hpp"

namespace priamos::bus::radio {

/// What a message of a channel takes of the bundles that carry it, at most.
struct EntrySizes {
  double entries = 1;     ///< of a message: several when it is cut into segments
  double entry_bits = 0;  ///< of the largest entry of the largest message, channel number and head included
  double bits = 0;        ///< of all entries of the largest message
  /// Of the entry of a message of one segment, where the largest message has several and sizes differ: first
  /// and last segment at once, it can be longer than any of those. Else 0.
  double single_bits = 0;
};

/// Sizes of the messages of a channel of the table.
EntrySizes SizesOf(const ChannelTable& table, std::size_t channel);

/// Bits of the largest entry that a message of this direction can need; 0 without channels.
std::size_t LargestEntryBits(const ChannelTable& table, Direction direction);

}  // namespace priamos::bus::radio
