#include "test/bus/radio/explorer/promises.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/radio/frame/cobs.hpp"
#include "bus/radio/frame/coded_block.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

/// On a line without accidents, with a tick and a frame in between.
constexpr Duration kUrgentWithin{50'000};

/// Content of what was sent between two delimiters; empty for the rest of a frame that was cut off.
std::vector<std::byte> ContentOf(std::span<const std::byte> encoded) {
  if (auto block = DecodeBlock(encoded)) return std::move(*block);
  return CobsDecode(encoded).value_or(std::vector<std::byte>{});
}

}  // namespace

Promises::Promises() : table_(TestChannels(), false), channels_(table_.size()) {}

void Promises::Break(std::string sentence) {
  broken_.push_back(std::move(sentence));
}

std::vector<std::byte> Promises::NextMessage(std::size_t channel, std::size_t size, Time now) {
  std::vector<Time>& offered = channels_[channel].offered;
  offered.push_back(now);
  std::vector<std::byte> message(size, std::byte{0x11});
  message[0] = static_cast<std::byte>(channel);
  if (size > 1) message[1] = static_cast<std::byte>(offered.size() - 1);
  if (size == 1) message[0] = static_cast<std::byte>(offered.size() - 1);
  return message;
}

void Promises::OnRefused(std::size_t channel) {
  channels_[channel].refused.insert(channels_[channel].offered.size() - 1);
}

void Promises::OnMemoryLost() {
  for (Channel& channel : channels_) channel.counted_from = channel.offered.size();
}

void Promises::OnDelivery(const Delivery& delivery, Direction incoming, Time now) {
  const LinkChannel& c = table_.at(delivery.channel);
  const std::size_t name_bytes = delivery.packed.size() > 1 ? 1 : 0;
  const auto number = std::to_integer<std::size_t>(delivery.packed[name_bytes]);
  Channel& channel = channels_[delivery.channel];
  if (c.direction != incoming || number >= channel.offered.size() ||
      (name_bytes > 0 && std::to_integer<std::size_t>(delivery.packed[0]) != delivery.channel))
    return Break(fmt::format("{}: a message that was never offered", c.name));
  if (c.channel_class != ChannelClass::kEvent && !channel.came.empty() && number <= channel.came.back())
    Break(fmt::format("{}: number {} after {}", c.name, number, channel.came.back()));
  if (c.channel_class == ChannelClass::kCommand) CheckCommand(channel, number, delivery, now);
  channel.took.push_back(now - channel.offered[number]);
  channel.came.push_back(number);
}

void Promises::CheckCommand(const Channel& channel, std::size_t number, const Delivery& delivery, Time now) {
  const Time offered = channel.offered[number];
  const LinkChannel& c = table_.at(delivery.channel);
  if (now - offered > c.ttl)
    Break(fmt::format("{}: number {} delivered {:.3f} s old", c.name, number, Seconds(now - offered)));
  if (delivery.packed_at > offered)
    Break(fmt::format("{}: number {} stamped {:.6f} s too young", c.name, number,
                      Seconds(delivery.packed_at - offered)));
}

void Promises::OnAccepted(std::span<const std::byte> frame, Direction direction) {
  if (!accepted_.insert({direction, {frame.begin(), frame.end()}}).second)
    Break(fmt::format("a frame was accepted twice in the direction {}",
                      direction == Direction::kUp ? "up" : "down"));
}

void Promises::OnFrame(std::span<const std::byte> encoded, Direction direction, std::uint64_t epoch,
                       const LinkKey& key) {
  const auto content = ContentOf(encoded);
  if (content.empty() || epoch == 0) return;
  const auto opener = [&](Direction d) -> FrameOpener& {
    const FrameScope scope{.table_hash = table_.hash(), .echo_bytes = d == Direction::kDown ? 1U : 0U};
    const auto [it, made] = openers_.try_emplace({d, epoch}, FrameKeys(key), d, scope);
    if (made) it->second.SetEpoch(epoch, 0);
    return it->second;
  };
  const Opened opened = opener(direction).Open(content, opener(Opposite(direction)).highest());
  const auto* reject = std::get_if<Reject>(&opened);
  if (reject != nullptr && *reject == Reject::kReplayed)
    Break(fmt::format("a counter was used twice in the direction {}",
                      direction == Direction::kUp ? "up" : "down"));
}

void Promises::OnKeyChange(KeyChange change, Direction outgoing) {
  if (change != KeyChange::kDone)
    Break(fmt::format("the end that sends {} does not use the next key",
                      outgoing == Direction::kUp ? "up" : "down"));
}

void Promises::Settle(Time recovered) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.channel_class == ChannelClass::kEvent) SettleEvents(i, channels_[i]);
    if (c.channel_class == ChannelClass::kCommand) SettleCommands(i, channels_[i], recovered);
    if (c.urgent) SettleUrgent(i, channels_[i], recovered);
  }
}

void Promises::SettleCommands(std::size_t index, const Channel& channel, Time recovered) {
  const auto first = std::lower_bound(channel.offered.begin(), channel.offered.end(), recovered);
  const auto number = static_cast<std::size_t>(first - channel.offered.begin());
  const auto came =
      std::count_if(channel.came.begin(), channel.came.end(), [&](std::size_t n) { return n >= number; });
  // The others may have been replaced by a newer one, while a stop went first.
  if (static_cast<double>(came) < 0.7 * static_cast<double>(channel.offered.end() - first))
    Break(fmt::format("{}: {} of {} came in the end", table_.at(index).name, came,
                      channel.offered.end() - first));
}

void Promises::SettleUrgent(std::size_t index, const Channel& channel, Time recovered) {
  for (std::size_t i = 0; i < channel.came.size(); ++i)
    if (channel.offered[channel.came[i]] >= recovered && channel.took[i] > kUrgentWithin)
      Break(fmt::format("{}: number {} took {:.3f} s in the end", table_.at(index).name, channel.came[i],
                        Seconds(channel.took[i])));
}

void Promises::SettleEvents(std::size_t index, const Channel& channel) {
  std::vector<std::size_t> owed, came;
  for (std::size_t n = channel.counted_from; n < channel.offered.size(); ++n)
    if (!channel.refused.contains(n)) owed.push_back(n);
  std::copy_if(channel.came.begin(), channel.came.end(), std::back_inserter(came),
               [&](std::size_t n) { return n >= channel.counted_from; });
  if (came != owed)
    Break(fmt::format("{}: came {}, expected {}", table_.at(index).name, fmt::join(came, " "),
                      fmt::join(owed, " ")));
}

}  // namespace priamos::bus::radio
