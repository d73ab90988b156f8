#include "bus/radio/channel_load.hpp"

#include <cmath>

#include "bus/radio/channels/entry_sizes.hpp"

namespace priamos::bus::radio {

double ChannelLoad::Arrivals(double window_s) const {
  return keys * (burst + std::floor(window_s / period_s));
}

double ChannelLoad::OwnBefore(double window_s) const {
  return entries > 1 || burst > 1 || keys > 1 ? Arrivals(window_s) - 1 : std::floor(window_s / period_s);
}

ChannelLoad LoadOf(const ChannelTable& table, std::size_t index) {
  const LinkChannel& c = table.at(index);
  ChannelLoad load;
  load.channel = index;
  load.urgent = c.urgent;
  load.newest_only = c.channel_class != ChannelClass::kEvent;
  load.command = c.channel_class == ChannelClass::kCommand;
  load.repeated = c.urgent && c.channel_class == ChannelClass::kEvent;
  load.priority = c.priority;
  load.period_s = c.rate_hz > 0 ? 1 / c.rate_hz : std::numeric_limits<double>::infinity();
  load.burst = c.burst;
  load.keys = c.max_keys;
  const EntrySizes sizes = SizesOf(table, index);
  load.entries = sizes.entries;
  load.entry_bits = sizes.entry_bits;
  load.bits = sizes.bits;
  load.single_bits = sizes.single_bits;
  return load;
}

}  // namespace priamos::bus::radio
