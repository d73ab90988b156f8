#include "radio/radio_messages.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace priamos::radio {
namespace {

using bus::radio::LinkChannel;
using bus::radio::LinkEndpoint;
using bus::radio::QueueCounters;
using bus::radio::Reject;

constexpr std::size_t kMaxChannels = 16;
constexpr std::size_t kMaxNameLength = 24;

std::int32_t Count(std::uint64_t count, std::int32_t limit = std::numeric_limits<std::int32_t>::max()) {
  return static_cast<std::int32_t>(std::min<std::uint64_t>(count, static_cast<std::uint64_t>(limit)));
}

link_channel_t ChannelToMessage(const LinkEndpoint& link, std::size_t index, Time now) {
  constexpr std::int32_t kLimit = 16777215;
  const QueueCounters& sent = link.sent(index);
  const auto& delivered = link.delivered(index);
  link_channel_t message{};
  message.channel = link.table().at(index).name.substr(0, kMaxNameLength);
  message.outgoing = link.table().at(index).direction == link.outgoing() ? 1 : 0;
  message.messages = Count(message.outgoing ? sent.sent : delivered.delivered, kLimit);
  message.bytes = Count((message.outgoing ? sent.bits : delivered.bits) / 8);
  message.replaced = Count(sent.replaced, kLimit);
  message.dropped = Count(sent.expired + sent.refused, kLimit);
  message.expired = Count(sent.expired, kLimit);
  message.unwanted = Count(sent.unwanted, kLimit);
  message.late = Count(delivered.late, kLimit);
  message.saturated = Count(sent.saturated, kLimit);
  message.queue_age_s = static_cast<float>(std::min(600.0, Seconds(link.OldestAge(index, now))));
  return message;
}

/// Share of the line that carried `bytes` in a time.
double Utilisation(std::uint64_t bytes, double bytes_per_s, Duration elapsed) {
  if (elapsed <= Duration::zero()) return 0;
  return std::min(1.0, static_cast<double>(bytes) / (bytes_per_s * Seconds(elapsed)));
}

void AddChannels(const LinkEndpoint& link, Time now, ReportState& state, link_status_t& message) {
  const std::size_t all = link.table().size();
  const std::size_t n = std::min(all - state.first_channel, kMaxChannels);
  message.all_channels = static_cast<std::int8_t>(all);
  message.first_channel = static_cast<std::int8_t>(state.first_channel);
  message.n_channels = static_cast<std::int8_t>(n);
  for (std::size_t i = 0; i < n; ++i)
    message.channels.push_back(ChannelToMessage(link, state.first_channel + i, now));
  state.first_channel = state.first_channel + n < all ? state.first_channel + n : 0;
}

}  // namespace

link_status_t ToMessage(const LinkEndpoint& link, double bytes_per_s, std::uint64_t undecodable,
                        Duration elapsed, Time now, ReportState& state) {
  const bus::radio::LinkStatus status = link.Status(now);
  const auto& counters = status.counters;
  const auto rejected = [&](Reject cause) { return counters.rejected[static_cast<std::size_t>(cause)]; };
  link_status_t message{};
  message.utime = ToUtime(now);
  message.up = status.up ? 1 : 0;
  message.alarm = status.alarm ? 1 : 0;
  message.table_mismatch = status.table_mismatch ? 1 : 0;
  message.onboard = link.outgoing() == bus::radio::Direction::kUp ? 1 : 0;
  message.utilisation = Utilisation(counters.bytes_sent - state.bytes_sent, bytes_per_s, elapsed);
  message.utilisation_in = Utilisation(counters.bytes_received - state.bytes_received, bytes_per_s, elapsed);
  state.bytes_sent = counters.bytes_sent;
  state.bytes_received = counters.bytes_received;
  message.undecodable = Count(counters.bundles_damaged + undecodable);
  message.bytes_sent = static_cast<std::int64_t>(counters.bytes_sent);
  message.bytes_received = static_cast<std::int64_t>(counters.bytes_received);
  message.frames_sent = Count(counters.frames_sent);
  message.frames_aborted = Count(counters.frames_aborted);
  message.frames_received = Count(counters.frames_received);
  message.frames_missed = Count(counters.frames_missed);
  message.rejected_malformed = Count(rejected(Reject::kMalformed) + rejected(Reject::kOversize));
  message.rejected_code = Count(rejected(Reject::kBadCode) + rejected(Reject::kNoEpoch));
  message.rejected_replayed = Count(rejected(Reject::kReplayed));
  message.rejected_flood = Count(rejected(Reject::kFlood) + state.turned_away);
  message.frames_rejected = Count(state.turned_away);
  for (const std::uint64_t n : counters.rejected)
    message.frames_rejected = Count(static_cast<std::uint64_t>(message.frames_rejected) + n);
  message.resent = Count(status.resent);
  message.loss = status.loss;
  message.peer_loss = status.peer_loss;
  message.bit_error_rate = std::min(0.1, status.bit_error_rate);
  message.latency_s = std::min(10.0, Seconds(status.latency));
  message.round_trip_s =
      status.round_trip < Duration::zero() ? -1 : std::min(60.0, Seconds(status.round_trip));
  std::uint64_t dropped = 0;
  for (std::size_t i = 0; i < link.table().size(); ++i)
    dropped += link.sent(i).expired + link.sent(i).refused;
  message.dropped = Count(dropped);
  AddChannels(link, now, state, message);
  return message;
}

}  // namespace priamos::radio
