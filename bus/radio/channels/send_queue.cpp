#include "bus/radio/channels/send_queue.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace priamos::bus::radio {

RateLimit::RateLimit(double rate_hz, int burst)
    : period_(rate_hz > 0 ? FromSeconds(1 / rate_hz) : Duration::zero()),
      tolerance_(period_ * (std::max(burst, 1) - 1)) {}

void RateLimit::Use(Time since) {
  previous_ = theoretical_;
  previous_next_ = next_;
  theoretical_ = std::max(theoretical_, since) + period_;
  next_ = theoretical_ - tolerance_;
}

SendQueue::SendQueue(const ChannelTable& table, Direction outgoing, Duration ageing)
    : outgoing_(outgoing), ageing_(ageing) {
  for (const LinkChannel& c : table.channels())
    lanes_.push_back({.channel = &c,
                      .slots = {},
                      .events = EventSender(),
                      .event_rate = RateLimit(c.rate_hz, c.burst),
                      .event_served = Time::min(),
                      .wanted = !c.on_request,
                      .counters = {}});
}

SendQueue::Slot* SendQueue::SlotFor(Lane& lane, std::string_view key) {
  for (Slot& slot : lane.slots)
    if (slot.key == key) return &slot;
  if (lane.slots.size() >= static_cast<std::size_t>(std::max(lane.channel->max_keys, 1))) return nullptr;
  lane.slots.push_back({.key = std::string(key),
                        .rate = RateLimit(lane.channel->rate_hz, lane.channel->burst),
                        .encoded = {},
                        .made_at = {},
                        .waiting_since = {}});
  return &lane.slots.back();
}

/// Whether a message that comes now is too old to be sent: nobody should have it after a newer one.
bool SendQueue::IsOutdated(const Slot& slot, Duration ttl, Time made_at, Time now) {
  return (ttl > Duration::zero() && made_at < now - ttl) ||
         (slot.newest && made_at < *slot.newest - kSameMoment);
}

bool SendQueue::Offer(std::size_t channel, std::string_view key, std::span<const std::byte> encoded, Time now,
                      std::optional<Time> made) {
  Lane& lane = lanes_[channel];
  ++lane.counters.offered;
  if (!lane.wanted) {
    ++lane.counters.unwanted;
    return true;
  }
  Slot* slot = SlotFor(lane, key);
  if (slot == nullptr) {
    ++lane.counters.refused;
    return false;
  }
  const Time made_at = std::min(made.value_or(now), now);
  if (IsOutdated(*slot, lane.channel->ttl, made_at, now)) {
    ++lane.counters.expired;
    return true;
  }
  if (slot->encoded) {
    ++lane.counters.replaced;
  } else {
    slot->waiting_since = now;  // for the line, and so for its rate, it waits since it came
  }
  slot->encoded.emplace(encoded.begin(), encoded.end());
  slot->made_at = made_at;
  slot->newest = std::max(made_at, slot->newest.value_or(made_at));
  return true;
}

bool SendQueue::OfferEvent(std::size_t channel, std::vector<std::byte> packed, std::size_t bits, Time now) {
  Lane& lane = lanes_[channel];
  ++lane.counters.offered;
  if (lane.events.Offer(std::move(packed), bits, now)) return true;
  ++lane.counters.refused;
  return false;
}

void SendQueue::Expire(Time now) {
  for (Lane& lane : lanes_) {
    if (lane.channel->ttl <= Duration::zero()) continue;
    for (Slot& slot : lane.slots) {
      if (!slot.encoded || now - slot.made_at <= lane.channel->ttl) continue;
      slot.encoded.reset();
      ++lane.counters.expired;
    }
  }
}

double SendQueue::Effective(const LinkChannel& channel, Time since, Time now) const {
  const Duration waited = std::max(now - since, Duration::zero());
  return channel.priority - std::floor(Seconds(waited) / Seconds(ageing_));
}

/// The rate of an urgent event is what the budget reckons with, and no limit: it goes at once, and before
/// repetitions of those before it.
bool SendQueue::EventReady(const Lane& lane, Time now) {
  return lane.events.Ready(now, lane.channel->urgent) &&
         (lane.channel->urgent || !lane.events.NextIsNew(now) || lane.event_rate.Allows(now));
}

void SendQueue::AddReady(const Lane& lane, std::size_t index, Time now, std::vector<Candidate>& ready) const {
  const LinkChannel& c = *lane.channel;
  if (commands_held_ && c.channel_class == ChannelClass::kCommand) return;
  const auto add = [&](std::size_t slot, Time since) {
    ready.push_back({.channel = index,
                     .slot = slot,
                     .urgent = c.urgent,
                     .priority = Effective(c, since, now),
                     .since = since});
  };
  if (c.channel_class == ChannelClass::kEvent) {
    if (EventReady(lane, now)) add(0, std::max(*lane.events.oldest(), lane.event_served));
    return;
  }
  for (std::size_t i = 0; i < lane.slots.size(); ++i) {
    const Slot& slot = lane.slots[i];
    // Before its rate allows it, a message does not wait for the line.
    if (slot.encoded && slot.rate.Allows(now)) add(i, std::max(slot.waiting_since, slot.rate.next()));
  }
}

std::vector<SendQueue::Candidate> SendQueue::Ready(Time now) const {
  std::vector<Candidate> ready;
  for (std::size_t i = 0; i < lanes_.size(); ++i)
    if (lanes_[i].channel->direction == outgoing_) AddReady(lanes_[i], i, now, ready);
  std::sort(ready.begin(), ready.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(!a.urgent, a.priority, a.since, a.channel, a.slot) <
           std::tuple(!b.urgent, b.priority, b.since, b.channel, b.slot);
  });
  return ready;
}

std::optional<SendQueue::Candidate> SendQueue::Newest(std::size_t channel) const {
  const Lane& lane = lanes_[channel];
  if (lane.slots.empty() || !lane.slots.front().encoded) return std::nullopt;
  const Slot& slot = lane.slots.front();
  return Candidate{.channel = channel,
                   .priority = static_cast<double>(lane.channel->priority),
                   .since = std::max(slot.waiting_since, slot.rate.next())};
}

bool SendQueue::UrgentReady(Time now) const {
  std::vector<Candidate> ready;
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    const Lane& lane = lanes_[i];
    if (lane.channel->urgent && lane.channel->direction == outgoing_ && !IsRepetition(i, now))
      AddReady(lane, i, now, ready);
  }
  return !ready.empty();
}

bool SendQueue::RepetitionReady(Time now) const {
  for (std::size_t i = 0; i < lanes_.size(); ++i)
    if (lanes_[i].channel->direction == outgoing_ && IsRepetition(i, now)) return true;
  return false;
}

bool SendQueue::UrgentUnanswered() const {
  return std::any_of(lanes_.begin(), lanes_.end(), [](const Lane& lane) {
    return lane.channel->urgent && !lane.events.events().empty() && lane.events.events().front().released;
  });
}

bool SendQueue::IsRepetition(std::size_t channel, Time now) const {
  const Lane& lane = lanes_[channel];
  return lane.channel->urgent && lane.channel->channel_class == ChannelClass::kEvent &&
         EventReady(lane, now) && !NextIsFresh(channel, now);
}

const std::vector<std::byte>& SendQueue::Peek(const Candidate& candidate) const {
  return *lanes_[candidate.channel].slots[candidate.slot].encoded;
}

Time SendQueue::MadeAt(const Candidate& candidate) const {
  return lanes_[candidate.channel].slots[candidate.slot].made_at;
}

std::optional<EventSegment> SendQueue::PeekEvent(std::size_t channel, Time now) const {
  const Lane& lane = lanes_[channel];
  return EventReady(lane, now) ? lane.events.Next(now, lane.channel->urgent) : std::nullopt;
}

bool SendQueue::NextIsFresh(std::size_t channel, Time now) const {
  const Lane& lane = lanes_[channel];
  return lane.events.NextIsFresh(now, lane.channel->urgent);
}

void SendQueue::TakeEvent(std::size_t channel, std::uint8_t number, Time now, Time leaves_at) {
  Lane& lane = lanes_[channel];
  const bool urgent = lane.channel->urgent;
  if (lane.events.NextIsNew(now, urgent))
    lane.event_rate.Use(std::max(lane.events.NextPackedAt(now, urgent), lane.event_rate.next()));
  lane.event_served = now;
  lane.events.MarkSent(number, now, leaves_at);
}

QueuedMessage SendQueue::Take(const Candidate& candidate) {
  Slot& slot = lanes_[candidate.channel].slots[candidate.slot];
  slot.rate.Use(candidate.since);
  QueuedMessage message{.channel = candidate.channel,
                        .key = slot.key,
                        .encoded = std::move(*slot.encoded),
                        .made_at = slot.made_at,
                        .waiting_since = slot.waiting_since};
  slot.encoded.reset();
  return message;
}

void SendQueue::Return(QueuedMessage message) {
  Lane& lane = lanes_[message.channel];
  Slot* slot = SlotFor(lane, message.key);
  if (slot == nullptr) return;
  slot->rate.Undo();
  slot->waiting_since = message.waiting_since;
  if (slot->encoded) {
    ++lane.counters.replaced;
    return;
  }
  slot->encoded = std::move(message.encoded);
  slot->made_at = message.made_at;
}

void SendQueue::CountSent(std::size_t channel, std::size_t bits) {
  ++lanes_[channel].counters.sent;
  lanes_[channel].counters.bits += bits;
}

Duration SendQueue::OldestAge(std::size_t channel, Time now) const {
  const Lane& lane = lanes_[channel];
  Duration oldest{};
  if (const auto since = lane.events.oldest()) oldest = now - *since;
  for (const Slot& slot : lane.slots)
    if (slot.encoded) oldest = std::max(oldest, now - slot.made_at);
  return oldest;
}

}  // namespace priamos::bus::radio
