#include "bus/radio/channels/entry_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "bus/radio/channels/event_stream.hpp"

namespace priamos::bus::radio {

EntrySizes SizesOf(const ChannelTable& table, std::size_t channel) {
  const LinkChannel& c = table.at(channel);
  EntrySizes sizes;
  const double body_bytes = std::ceil(c.max_bits / 8.0);
  const double body_bits = c.fixed_bits > 0 ? c.fixed_bits + (c.delta.empty() ? 0 : 1) : 8 + 8 * body_bytes;
  if (c.channel_class != ChannelClass::kEvent) {
    const int age_bits = c.channel_class == ChannelClass::kCommand ? 6 : 0;
    sizes.bits = sizes.entry_bits = table.id_bits() + age_bits + body_bits;
    return sizes;
  }
  sizes.entries = std::max(1.0, std::ceil(body_bytes / kSegmentBytes));
  const bool one_segment = c.fixed_bits > 0 && sizes.entries == 1;
  // Each as if it began a run, and with the bit that ends it.
  const double head_bits = table.id_bits() + 8 + (one_segment ? 1 : 3) + (c.urgent ? 0 : 1);
  if (sizes.entries == 1) {
    sizes.bits = sizes.entry_bits = head_bits + 12 + body_bits;
    return sizes;
  }
  sizes.bits = sizes.entries * head_bits + 12 + 5 + 8 * body_bytes;
  sizes.entry_bits = head_bits + 12 + 8.0 * kSegmentBytes;  // the first; the last has a length, and no age
  if (c.fixed_bits == 0) sizes.single_bits = sizes.entry_bits + 5;
  return sizes;
}

std::size_t LargestEntryBits(const ChannelTable& table, Direction direction) {
  double largest = 0;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table.at(i).direction == direction)
      largest = std::max({largest, SizesOf(table, i).entry_bits, SizesOf(table, i).single_bits});
  return static_cast<std::size_t>(std::ceil(largest));
}

}  // namespace priamos::bus::radio
