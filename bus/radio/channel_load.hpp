#pragma once

#include <cstddef>
#include <limits>

#include "bus/radio/channels/channel_table.hpp"

/// How often the messages of a channel come, and how large they are.
namespace priamos::bus::radio {

/// One channel as a load on its direction.
struct ChannelLoad {
  std::size_t channel = 0;
  bool urgent = false;
  bool newest_only = false;  ///< a newer message replaces one that waits
  bool command = false;
  bool repeated = false;  ///< an urgent event: repeated until it is acknowledged
  int priority = 0;
  double period_s = 0;
  double burst = 1;
  double keys = 1;
  double entries = 1;      ///< number of entries per message
  double entry_bits = 0;   ///< bits of the largest entry
  double bits = 0;         ///< bits of all entries of a message
  double single_bits = 0;  ///< bits of a message of one entry, if that can be longer; else 0
  double latency_s = std::numeric_limits<double>::infinity();

  /// Number of messages that can come in a window of this length.
  double Arrivals(double window_s) const;
  /// Largest number of messages of the same channel ahead of one that waits for `window_s`.
  double OwnBefore(double window_s) const;
};

/// The load of one channel of a table at its configured rate.
ChannelLoad LoadOf(const ChannelTable& table, std::size_t index);

}  // namespace priamos::bus::radio
