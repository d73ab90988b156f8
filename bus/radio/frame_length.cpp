#include "bus/radio/frame_length.hpp"

#include <cmath>
#include <optional>

#include "bus/radio/channels/entry_sizes.hpp"
#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {
namespace {

/// Index of the most frequent command of a direction; nullopt: it has none with a rate.
std::optional<std::size_t> MostFrequentCommand(const ChannelTable& table, Direction direction) {
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const LinkChannel& c = table.at(i);
    if (c.direction != direction || c.channel_class != ChannelClass::kCommand || c.rate_hz <= 0) continue;
    if (!most || c.rate_hz > table.at(*most).rate_hz) most = i;
  }
  return most;
}

}  // namespace

FrameLength FrameLengthOf(const ChannelTable& table, const LinkOptions& options, Direction direction) {
  const FrameLength usual{.bundle_bytes = options.max_bundle_bytes, .strict = options.robots > 0};
  const auto command = MostFrequentCommand(table, direction);
  const bool by_turns = options.half_duplex.turn > Duration::zero() || options.robots > 0;
  if (!command || by_turns || options.packets()) return usual;
  const std::size_t beside =
      FrameOverhead(table.code_bytes()) + options.HeadBytes() + EchoBytes(options.bytes_per_s);
  const double bytes =
      std::floor(options.bytes_per_s / table.at(*command).rate_hz) - static_cast<double>(beside);
  const auto least_bits = static_cast<double>(LargestEntryBits(table, direction));
  const bool fits = 8 * bytes >= least_bits && bytes <= static_cast<double>(options.max_bundle_bytes);
  return fits ? FrameLength{.bundle_bytes = static_cast<std::size_t>(bytes), .strict = true} : usual;
}

}  // namespace priamos::bus::radio
