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
constexpr std::uint32_t kLargestEvent = 1400, kLargestWhole = 200;  // bytes

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
    throw std::invalid_argument(fmt::format(
        "{}: expected false, other than for a state of fixed size without keys, got true", c.At("delta")));
  if (c.fixed_bits == 0 && c.max_bits == 0)
    throw std::invalid_argument(
        fmt::format("{}: expected a type whose packed size is known, got another", c.At("type")));
  if (c.channel_class == ChannelClass::kCommand && c.ttl <= Duration::zero())
    throw std::invalid_argument(
        fmt::format("{}: expected a time-to-live, as every command needs, got none", c.At("ttl_s")));
  if (c.channel_class == ChannelClass::kEvent && c.max_bits > 8 * kLargestEvent)
    throw std::invalid_argument(fmt::format("{}: expected an event of at most {} bytes, got {} bits",
                                            c.At("type"), kLargestEvent, c.max_bits));
  if (c.channel_class != ChannelClass::kEvent && c.max_bits > 8 * kLargestWhole)
    throw std::invalid_argument(fmt::format(
        "{}: expected \"event\" for messages of {} bits, more than the {} bytes that fit one frame, got "
        "\"{}\"",
        c.At("class"), c.max_bits, kLargestWhole,
        c.channel_class == ChannelClass::kState ? "state" : "command"));
}

}  // namespace

ChannelTable::ChannelTable(std::vector<LinkChannel> channels, bool encrypted, std::size_t code_bytes)
    : channels_(std::move(channels)), encrypted_(encrypted), code_bytes_(code_bytes) {
  if (code_bytes_ != kShortCodeBytes && code_bytes_ != 6 && code_bytes_ != 8)
    throw std::invalid_argument(fmt::format("expected codes of 4, 6 or 8 bytes, got {}", code_bytes_));
  if (channels_.empty() || channels_.size() > kMaxChannels)
    throw std::invalid_argument(
        fmt::format("expected 1 to {} channels of a radio link, got {}", kMaxChannels, channels_.size()));
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    LinkChannel& c = channels_[i];
    if (c.fixed_bits > 0) c.max_bits = c.fixed_bits;
    Check(c);
    for (std::size_t j = 0; j < i; ++j)
      if (channels_[j].name == c.name && channels_[j].direction == c.direction)
        throw std::invalid_argument(
            fmt::format("{}: expected a channel once in a direction, got it twice", c.At("name")));
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
