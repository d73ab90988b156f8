#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bus/radio/bundle_builder.hpp"
#include "bus/radio/channels/delta.hpp"
#include "bus/radio/channels/send_queue.hpp"

namespace priamos::bus::radio {

/// A packed message.
struct Packed {
  std::vector<std::byte> bytes;
  std::size_t bits = 0;    ///< number of bits used, from the first bit of `bytes` on
  bool saturated = false;  ///< a field was outside its range
};

/// Packs the encoded message of a channel. Time stamps are sent as ages at `now`: of a command when it was
/// made, of any other message when it is sent. nullopt if the message must not be sent: it is none of the
/// channel's type, or has a value that is refused.
using PackFunction =
    std::function<std::optional<Packed>(std::size_t channel, std::span<const std::byte> encoded, Time now)>;

/// What became of an offered message; kNotOutgoing: this end does not send the channel.
enum class OfferResult { kAccepted, kRefused, kNotOutgoing };

/// The frame that messages are loaded into.
struct Departure {
  Time now{};
  std::uint64_t counter = 0;
  bool urgent_only = false;
  /// Time at which a frame of so many bytes, begun now, will have left.
  std::function<Time(std::size_t bytes)> leaves_at;
  /// Arrival of the frame that this one echoes; nullopt: it has no echo, and no commands.
  std::optional<Time> echoed_at{};
  /// Bytes of a bundle, begun now, that the other end has and can prove fresh until a time; 0: none, none
  /// given: any.
  std::function<std::size_t(Time until)> bytes_until{};
};

/// Puts messages into bundles: it packs them, sends states as differences where that is shorter, and
/// puts messages of a frame that was cut off back. SendQueue decides the order.
class MessageSender {
 public:
  /// Sender of the channels of `table`, which must outlive it and its copies. `outgoing`: direction of the
  /// messages sent.
  MessageSender(const ChannelTable& table, Direction outgoing, Duration ageing, PackFunction pack);

  /// An encoded message for an outgoing channel; messages with different keys do not replace each other.
  /// `made`: see SendQueue::Offer; an event has no age.
  OfferResult Offer(std::size_t channel, std::span<const std::byte> encoded, Time now, std::string_view key,
                    std::optional<Time> made = {});

  /// The messages and segments in a frame.
  struct Loaded {
    /// A state or command in the frame.
    struct Message {
      QueuedMessage queued;
      std::size_t bits;  ///< packed bits on the line
      /// Message as the other end will have it; empty unless the channel sends differences.
      std::vector<std::byte> packed;
    };
    /// A piece of an event in the frame, by its number in the channel's stream.
    struct Segment {
      std::size_t channel;
      std::uint8_t number;
    };
    std::vector<Message> messages;
    std::vector<Segment> segments;
    /// Whether it has a state or command of the channel.
    bool Has(std::size_t channel) const;
  };
  /// Adds a state to an empty bundle, whatever its rate, and limits that to so many bytes.
  Loaded LoadFirst(BundleBuilder& bundle, const SendQueue::Candidate& first, std::size_t most_bytes,
                   const Departure& departure);
  /// Adds messages and segments of events to `bundle`, those that go first as long as they fit.
  /// `loaded`: what is in it already.
  Loaded Load(BundleBuilder& bundle, const Departure& departure, Loaded loaded = {});
  /// Takes back the contents of a frame that was cut off: nothing of it was sent.
  void Return(Loaded loaded);
  /// What waits beside the messages of a channel.
  struct Beside {
    std::optional<SendQueue::Candidate> alone{};  ///< the next one, when it is longer than a bundle
    std::size_t alone_bytes = 0;                  ///< of a bundle with the longest of its channel
    std::size_t bytes = 0;                        ///< of a bundle with all others, at most `target_bytes`
  };
  /// `promised`: a message that goes alone next, if it still waits, whatever the order of the queue.
  Beside WaitingBeside(std::size_t channel, const std::optional<SendQueue::Candidate>& promised,
                       std::size_t target_bytes, Time now) const;
  /// Notes that the frame with this counter has left whole.
  void OnSent(Loaded loaded, std::uint64_t counter);

  /// Returns how many events were acknowledged for the first time.
  std::size_t OnEventAck(const EventAckEntry& entry, Time now);
  /// Notes that the other end accepted the frame with this counter.
  void OnFrameAcknowledged(std::uint64_t counter);
  /// The other end does not have the baselines of differences.
  void ForgetBaselines();
  /// Makes events that are not acknowledged due at once, because the link is up again.
  void OnLinkBack() { ResendEvents(false); }
  /// Notes that counters begin anew: the other end may have lost what it held.
  void OnEpochChanged();

  SendQueue& queue() { return queue_; }
  const SendQueue& queue() const { return queue_; }
  /// Time from a segment of an event to its acknowledgement, smoothed; negative before the first.
  Duration round_trip() const { return round_trip_.smoothed(); }
  /// Number of segments of events that were sent again.
  std::uint64_t resent() const;

 private:
  std::size_t BitsOf(const SendQueue::Candidate& candidate, Time now) const;
  void LoadSegments(std::size_t channel, BundleBuilder& bundle, const Departure& departure, Loaded& loaded);
  bool LoadSegment(std::size_t channel, BundleBuilder& bundle, const Departure& departure, Loaded& loaded);
  bool MayLoad(const SendQueue::Candidate& candidate, const Departure& departure) const;
  void LoadNewest(const SendQueue::Candidate& candidate, BundleBuilder& bundle, const Departure& departure,
                  Loaded& loaded);
  BundleEntry EntryOf(const SendQueue::Candidate& candidate, const Packed& packed,
                      const Departure& departure) const;
  void ResendEvents(bool forgotten);

  const ChannelTable* table_;
  Direction outgoing_;
  PackFunction pack_;
  SendQueue queue_;
  std::vector<DeltaSender> deltas_;  ///< by channel
  RoundTrip round_trip_;
};

}  // namespace priamos::bus::radio
