#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "common/time.hpp"

/// Events of one channel: acknowledged, in order, exactly once. An event is cut into numbered segments that
/// are sent until they are acknowledged; the receiver delivers an event when all of it and of those before it
/// is there. Numbers are modulo 256 and never more than kEventWindow apart, so they are never ambiguous.
namespace priamos::bus::radio {

/// Bytes of a segment, except the last of an event. Small, so that segments fill what other entries leave of
/// a frame. Part of the protocol: a restarted sender must cut as before.
inline constexpr std::size_t kSegmentBytes = 26;
/// Largest number of segments sent and not acknowledged: one event of 1456 bytes.
inline constexpr std::size_t kEventWindow = 56;
/// Segments behind the first missing one whose receipt an acknowledgement reports.
inline constexpr std::size_t kAckWindow = 16;

/// Estimate of when an acknowledgement is overdue (Jacobson, Karels 1988; samples as in Karn, Partridge
/// 1987).
class RoundTrip {
 public:
  void Sample(Duration round_trip);
  /// Smoothed round trip; negative before the first sample.
  Duration smoothed() const { return smoothed_; }
  Duration timeout() const;

 private:
  Duration smoothed_{-1};
  Duration deviation_{};
};

/// One numbered piece of an event.
struct EventSegment {
  std::uint8_t number = 0;
  bool base = false;     ///< this is the oldest segment that is not acknowledged
  bool first = false;    ///< it begins its event
  bool last = false;     ///< it ends its event
  Duration age{};        ///< time since the event was packed; first segment only
  std::size_t bits = 0;  ///< number of bits used, from the first bit of `bytes` on
  std::vector<std::byte> bytes;
};

/// Acknowledgement of one channel by its receiver.
struct EventAck {
  std::uint8_t next = 0;    ///< everything before it was delivered
  std::uint8_t prefix = 0;  ///< number of segments from `next` on that are there; the one behind them is not
  std::uint16_t held = 0;   ///< bit i: segment next + prefix + 1 + i is there, too
};

/// Sender's side of one channel: events that wait, and segments that are sent but not acknowledged. The
/// functions that say what goes next take `urgent`: then what was never sent goes before repetitions, so that
/// an event does not travel with repetitions of the one before, and these are due in every frame, without a
/// timeout, in turn.
class EventSender {
 public:
  static constexpr std::size_t kCapacity = 64;

  /// An event that waits, or is being sent, in segments numbered from `first` on (modulo 256).
  struct Event {
    std::uint8_t first = 0;
    Time packed_at{};
    std::size_t bits = 0;
    std::vector<std::byte> packed;
    bool released = false;  ///< some of it was sent, even if an urgent message cut that off
  };

  /// Empty queue of events. `next`: number of the first new segment.
  explicit EventSender(std::uint8_t next = 0) : next_(next) {}

  /// Queues an event; false if the queue is full or the event has more than kEventWindow segments.
  bool Offer(std::vector<std::byte> packed, std::size_t bits, Time now);
  /// Puts back an event from before a restart; its number follows the one put back before.
  void Restore(Event event);

  /// Whether a segment is to be sent now: new, or its acknowledgement overdue.
  bool Ready(Time now, bool urgent = false) const;
  /// The segment to be sent next, nullopt when there is none.
  std::optional<EventSegment> Next(Time now, bool urgent = false) const;
  /// Whether the segment of Next() was never sent.
  bool NextIsFresh(Time now, bool urgent) const;
  /// Whether the segment of Next() begins an event of which nothing was sent.
  bool NextIsNew(Time now, bool urgent = false) const;
  /// Time at which the event of the segment of Next() was packed.
  Time NextPackedAt(Time now, bool urgent = false) const;
  /// Notes that a segment is sent in a frame that begins at `now`, and whose last byte leaves at `leaves_at`.
  void MarkSent(std::uint8_t number, Time now, Time leaves_at);
  /// Marks the segment as not sent, because its frame was aborted.
  void MarkUnsent(std::uint8_t number);
  /// Takes an acknowledgement. Returns how many events were acknowledged for the first time.
  std::size_t OnAck(const EventAck& ack, Time now, RoundTrip& round_trip);
  /// Makes every segment that was sent and not acknowledged due at once, as the link is up again.
  /// `forgotten`: the receiver lost the segments that it held.
  void ResendAll(bool forgotten);
  void set_timeout(Duration timeout) { timeout_ = timeout; }

  const std::deque<Event>& events() const { return events_; }
  std::uint8_t next() const { return next_; }
  /// Time at which the oldest event was packed; nullopt when there is none.
  std::optional<Time> oldest() const;
  std::uint64_t resent() const { return resent_; }

 private:
  struct Segment {
    std::uint8_t number = 0;
    std::size_t event = 0;   ///< counted since construction
    std::size_t offset = 0;  ///< into the packed event
    bool held = false;
    bool sent = false;
    int times = 0;
    Time begun_at{};
    Time sent_at{};
  };
  void Cut(const Event& event);
  bool Due(const Segment& segment, Time now, bool urgent) const;
  const Segment* NextDue(Time now, bool urgent) const;
  Segment* Find(std::uint8_t number);

  std::uint8_t next_;
  std::deque<Event> events_;
  std::deque<Segment> segments_;  ///< segments of all events_, in order
  std::size_t first_event_ = 0;   ///< number of events acknowledged so far
  Duration timeout_{600'000};
  std::uint64_t resent_ = 0;
};

/// Receiver's side of one channel: keeps segments until those before them have arrived.
class EventReceiver {
 public:
  /// An event that has arrived whole.
  struct Event {
    std::vector<std::byte> packed;
    std::size_t bits = 0;
    Time packed_at{};  ///< in the receiver's clock
  };

  EventReceiver() = default;
  EventReceiver(std::uint8_t next, bool known) : next_(next), known_(known) {}

  /// Takes a segment and returns the events that are complete now. `sent_at`: time of sending by the
  /// receiver's clock.
  std::vector<Event> OnSegment(const EventSegment& segment, Time sent_at);
  /// The sender's numbering began anew.
  void Forget();

  EventAck ack() const;
  bool ack_due() const { return ack_due_; }
  void set_ack_due(bool due) { ack_due_ = due; }
  std::uint8_t next() const { return next_; }
  bool known() const { return known_; }

 private:
  struct Held {
    EventSegment segment;
    Time packed_at{};
  };
  void Advance(std::size_t segments);
  std::optional<Event> TakeComplete();

  std::array<std::optional<Held>, kEventWindow> held_;
  std::uint8_t next_ = 0;
  bool known_ = false;
  bool ack_due_ = false;
};

}  // namespace priamos::bus::radio
