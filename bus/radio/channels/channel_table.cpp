#include "bus/radio/channels/channel_table.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr int kStateWithDeltas = 3;

std::uint32_t Hash(const std::string& text) {
  std::array<unsigned char, 16> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), nullptr, 0);
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | hash[static_cast<std::size_t>(i)];
  return value;
}

bool DeltaFits(const LinkChannel& c) {
  return c.channel_class == ChannelClass::kState && c.max_keys == 1 &&
         std::accumulate(c.delta.begin(), c.delta.end(), std::uint32_t{0}) == c.fixed_bits &&
         std::all_of(c.delta.begin(), c.delta.end(), [](int width) { return width >= 1 && width <= 64; });
}

void Check(const LinkChannel& c) {
  if (!c.delta.empty() && !DeltaFits(c))
    throw std::invalid_argument(
        fmt::format("{}: differences are for a state of fixed size without keys", c.Title()));
  if (c.fixed_bits == 0 && c.max_bits == 0)
    throw std::invalid_argument(fmt::format("{}: its packed size is unknown", c.Title()));
  if (c.channel_class == ChannelClass::kCommand && c.ttl <= Duration::zero())
    throw std::invalid_argument(fmt::format("{}: a command needs a time-to-live", c.Title()));
  if (c.channel_class == ChannelClass::kEvent && c.max_bits > 8 * 1400)
    throw std::invalid_argument(fmt::format("{}: larger than 1400 bytes", c.Title()));
  if (c.channel_class != ChannelClass::kEvent && c.max_bits > 8 * 200)
    throw std::invalid_argument(
        fmt::format("{}: a {} of {} bits does not fit one frame, make it an event", c.Title(),
                    c.channel_class == ChannelClass::kState ? "state" : "command", c.max_bits));
}

}  // namespace

ChannelTable::ChannelTable(std::vector<LinkChannel> channels, bool encrypted, std::size_t code_bytes)
    : channels_(std::move(channels)), encrypted_(encrypted), code_bytes_(code_bytes) {
  if (code_bytes_ != kShortCodeBytes && code_bytes_ != 6 && code_bytes_ != 8)
    throw std::invalid_argument(
        fmt::format("a radio link has codes of 4, 6 or 8 bytes, not of {}", code_bytes_));
  if (channels_.empty() || channels_.size() > kMaxChannels)
    throw std::invalid_argument(
        fmt::format("a radio link has 1 to {} channels, not {}", kMaxChannels, channels_.size()));
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    LinkChannel& c = channels_[i];
    if (c.fixed_bits > 0) c.max_bits = c.fixed_bits;
    Check(c);
    for (std::size_t j = 0; j < i; ++j)
      if (channels_[j].name == c.name && channels_[j].direction == c.direction)
        throw std::invalid_argument(
            fmt::format("{}: expected a channel once in a direction, got it twice", c.Title()));
  }
  hash_ = Hash(Text());
  id_bits_ = static_cast<int>(std::bit_width(channels_.size() + 1));
}

bool ChannelTable::HasCommands(Direction direction) const {
  return std::any_of(channels_.begin(), channels_.end(), [&](const LinkChannel& c) {
    return c.direction == direction && c.channel_class == ChannelClass::kCommand;
  });
}

std::string ChannelTable::Text() const {
  std::string text = fmt::format("priamos radio 1 table {}", encrypted_ ? "sealed" : "clear");
  if (code_bytes_ != kShortCodeBytes) text += fmt::format(" code {}", code_bytes_);
  text += "\n";
  for (const LinkChannel& c : channels_) {
    text += fmt::format("{} {:016x} {} {} {} {} {}", c.name, c.fingerprint, static_cast<int>(c.direction),
                        c.delta.empty() ? static_cast<int>(c.channel_class) : kStateWithDeltas, c.fixed_bits,
                        c.max_bits, c.channel_class == ChannelClass::kCommand ? c.ttl.count() : 0);
    if (!c.delta.empty()) text += fmt::format(" {}", fmt::join(c.delta, ","));
    text += "\n";
  }
  return text;
}

}  // namespace priamos::bus::radio
