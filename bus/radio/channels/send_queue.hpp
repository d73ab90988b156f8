#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/channels/event_stream.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// Counters of what became of the messages offered on one outgoing channel.
struct QueueCounters {
  std::uint64_t offered = 0;
  std::uint64_t sent = 0;       ///< state, command: left the line whole; event: acknowledged
  std::uint64_t replaced = 0;   ///< a newer one came before it was sent
  std::uint64_t expired = 0;    ///< older than its time-to-live before it was sent
  std::uint64_t refused = 0;    ///< queue full, too many keys, not packable, a refused value
  std::uint64_t unwanted = 0;   ///< channel on request, without a listener
  std::uint64_t saturated = 0;  ///< sent with a field outside its range set to the limit
  std::uint64_t bits = 0;       ///< packed bits handed to the line, repetitions included
};

/// Limit of `rate` messages per second on average and `burst` at once (generic cell rate algorithm).
class RateLimit {
 public:
  RateLimit(double rate_hz, int burst);
  Time next() const { return next_; }
  bool Allows(Time now) const { return now >= next_; }
  /// Counts a message as sent. `since`: time from which it could have been sent, so that waiting for the line
  /// does not slow it down.
  void Use(Time since);
  /// Reverts the last Use, because the message was not sent after all.
  void Undo() {
    theoretical_ = previous_;
    next_ = previous_next_;
  }

 private:
  Duration period_;
  Duration tolerance_;
  Time theoretical_ = Time::min();
  Time previous_ = Time::min();  ///< `theoretical_` before the last Use()
  Time next_ = Time::min();
  Time previous_next_ = Time::min();  ///< `next_` before the last Use()
};

/// A message taken out of the queue for the frame being sent.
struct QueuedMessage {
  std::size_t channel = 0;
  std::string key;
  std::vector<std::byte> encoded;
  Time made_at{};
  Time waiting_since{};
};

/// Queue of everything that one end wants to send: per channel the newest message (per key), or the events in
/// order, and which one is next. Order: urgent channels, then priority; a message gains one level of priority
/// per `ageing` that it waits, so that none waits for ever; then the one that waits longest. Events that wait
/// behind others of their channel gain nothing, or a long queue of them would block all other channels.
class SendQueue {
 public:
  /// A channel (and key) with something that may be sent now.
  struct Candidate {
    std::size_t channel = 0;
    std::size_t slot = 0;  ///< place of the key; state and command channels
    bool urgent = false;
    double priority = 0;
    Time since{};
  };

  /// Messages that were made so little apart may come in either order: two senders, or a process that had no
  /// time for its bus.
  static constexpr Duration kSameMoment{10'000};

  SendQueue(const ChannelTable& table, Direction outgoing, Duration ageing);

  /// Queues a message of a state or command channel; it replaces the one with the same key. `made`: when it
  /// was made, where that is before `now`; later, or left out, it is taken as made now. Its time-to-live
  /// counts from there. One that has outlived that is counted as expired, and so is one that was made more
  /// than kSameMoment before the newest of its key: neither replaces anything. False when it is refused: it
  /// has one key too many.
  bool Offer(std::size_t channel, std::string_view key, std::span<const std::byte> encoded, Time now,
             std::optional<Time> made = {});
  /// Queues an event; false if the queue of the channel is full.
  bool OfferEvent(std::size_t channel, std::vector<std::byte> packed, std::size_t bits, Time now);
  /// Whether the other end has a listener for an on-request channel.
  void SetWanted(std::size_t channel, bool wanted) { lanes_[channel].wanted = wanted; }
  bool wanted(std::size_t channel) const { return lanes_[channel].wanted; }

  /// Commands are not ready while `hold`: a frame of now could not prove that they are fresh.
  void HoldCommands(bool hold) { commands_held_ = hold; }

  /// Drops messages that are older than their time-to-live.
  void Expire(Time now);
  /// The messages that may be sent now, in order of priority.
  std::vector<Candidate> Ready(Time now) const;
  /// The waiting message of a state channel without keys, also when its rate does not let it go yet: `since`
  /// is when it does. nullopt: none waits.
  std::optional<Candidate> Newest(std::size_t channel) const;
  /// Whether an urgent channel has something that was never sent.
  bool UrgentReady(Time now) const;
  /// Whether some of an urgent event was sent, and it is not acknowledged.
  bool UrgentUnanswered() const;
  /// Whether a repetition of an urgent event can be sent.
  bool RepetitionReady(Time now) const;
  /// Whether a channel has only urgent events that were sent and are not acknowledged.
  bool IsRepetition(std::size_t channel, Time now) const;

  const std::vector<std::byte>& Peek(const Candidate& candidate) const;
  /// When the message was made.
  Time MadeAt(const Candidate& candidate) const;
  QueuedMessage Take(const Candidate& candidate);
  /// The segment an event channel would send next; the channel's rate only holds back new events,
  /// and no urgent ones.
  std::optional<EventSegment> PeekEvent(std::size_t channel, Time now) const;
  /// Whether the segment of PeekEvent() was never sent before.
  bool NextIsFresh(std::size_t channel, Time now) const;
  /// Notes that the segment is sent; its last byte leaves at `leaves_at`.
  void TakeEvent(std::size_t channel, std::uint8_t number, Time now, Time leaves_at);
  /// Puts a message of an aborted frame back, unless a newer one is queued already.
  void Return(QueuedMessage message);
  void CountSent(std::size_t channel, std::size_t bits);
  void CountRefused(std::size_t channel) { ++lanes_[channel].counters.refused; }

  EventSender& events(std::size_t channel) { return lanes_[channel].events; }
  const EventSender& events(std::size_t channel) const { return lanes_[channel].events; }
  QueueCounters& counters(std::size_t channel) { return lanes_[channel].counters; }
  const QueueCounters& counters(std::size_t channel) const { return lanes_[channel].counters; }
  /// Age of the oldest message waiting on a channel; zero when none waits.
  Duration OldestAge(std::size_t channel, Time now) const;

 private:
  struct Slot {
    std::string key;
    RateLimit rate;
    std::optional<std::vector<std::byte>> encoded;
    Time made_at{};
    Time waiting_since{};
    std::optional<Time> newest{};  ///< when the newest was made that was ever queued here
  };
  struct Lane {
    const LinkChannel* channel;
    std::vector<Slot> slots;
    EventSender events;
    RateLimit event_rate;
    Time event_served = Time::min();  ///< a segment was sent
    bool wanted = true;
    QueueCounters counters;
  };
  Slot* SlotFor(Lane& lane, std::string_view key);
  static bool IsOutdated(const Slot& slot, Duration ttl, Time made_at, Time now);
  double Effective(const LinkChannel& channel, Time since, Time now) const;
  static bool EventReady(const Lane& lane, Time now);
  void AddReady(const Lane& lane, std::size_t index, Time now, std::vector<Candidate>& ready) const;

  Direction outgoing_;
  Duration ageing_;
  bool commands_held_ = false;
  std::vector<Lane> lanes_;
};

}  // namespace priamos::bus::radio
