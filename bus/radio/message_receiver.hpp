#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bus/radio/bundle_builder.hpp"
#include "bus/radio/channels/delta.hpp"
#include "bus/radio/channels/event_stream.hpp"

namespace priamos::bus::radio {

/// A message from the other end.
struct Delivery {
  std::size_t channel = 0;
  std::vector<std::byte> packed;
  /// When it was packed, in this end's clock: its ages count from here. A command was packed when it was
  /// offered, which was at this time or later.
  Time packed_at{};
  std::optional<Time> valid_until{};  ///< commands only: they must not be obeyed later
};

/// Counters of one incoming channel.
struct DeliveryCounters {
  std::uint64_t delivered = 0;  ///< messages
  /// Messages refused: a command that may be too old, a message overtaken by a newer one, a difference to a
  /// message from before a restart.
  std::uint64_t late = 0;
  std::uint64_t bits = 0;  ///< packed bits of the messages delivered
};

/// Of two frames that follow each other the numbers of events are at most 112 apart: what one may have in
/// flight beyond what the other has.
inline constexpr std::uint64_t kFramesApart = 1;

/// The frame that brought a message.
struct Arrival {
  std::uint64_t counter = 0;
  bool newest = true;  ///< false: a frame that was sent later arrived before
  /// Counters by which it was overtaken; 0 when it is the newest. Numbers of events are modulo 256, and
  /// unambiguous only for a frame that was overtaken by no more than kFramesApart.
  std::uint64_t behind = 0;
  Time sent_at{};  ///< when its first byte was sent, in this end's clock
  Time began{};    ///< arrival of its first byte, had its bytes come one after the other
  Time now{};      ///< arrival of its last byte
  /// When the frame of this end that it echoes was handed over; nullopt: it has no echo, or one of a frame
  /// from before a restart.
  std::optional<Time> echoed{};
};

/// Turns the entries of accepted bundles into messages: refuses late ones, applies differences, puts events
/// in order, and keeps the acknowledgements and requests that are due.
class MessageReceiver {
 public:
  /// Receiver of the channels of `table`, which must outlive it and its copies.
  explicit MessageReceiver(const ChannelTable& table);

  /// Takes a state; appends the message to `out` unless it is refused.
  void OnState(StateEntry entry, const Arrival& arrival, std::vector<Delivery>& out);
  /// Takes a command; appends it to `out` if it is certainly not older than its time-to-live. It was offered
  /// by its offset after the echoed frame had arrived over there, which cannot have been before that frame
  /// was handed over here: no delay of either direction can make it older than that.
  void OnCommand(CommandEntry entry, const Arrival& arrival, std::vector<Delivery>& out);
  /// Takes a segment of an event. Returns whether the numbers of events() have changed: they must be
  /// remembered before the acknowledgement leaves, or a restarted end would deliver events again.
  bool OnEvent(const EventEntry& entry, const Arrival& arrival, std::vector<Delivery>& out);
  /// Notes that counters begin anew: no difference can refer to what came before.
  void OnEpochChanged();
  /// The other end's numbering of events began anew.
  void ForgetEvents();

  /// Which entries a frame carries, to be given back when it is cut off.
  struct Loaded {
    bool forget = false;
    bool news = false;              ///< the first acknowledgement of an urgent event
    std::vector<std::size_t> acks;  ///< channels whose acknowledgements are in it
  };
  bool AckDue() const;
  /// Whether an acknowledgement of urgent events is due, first or repeated: until it arrives, the other end
  /// repeats them.
  bool UrgentAckDue() const;
  /// Whether an urgent event is not acknowledged yet.
  bool UrgentNews() const { return urgent_news_; }
  /// Whether an entry of Load() is so urgent that a frame is sent for it alone.
  bool Due() const { return forget_due_ || AckDue(); }
  /// Adds the entries that are due, or those of urgent events alone; they count as sent.
  Loaded Load(BundleBuilder& bundle, bool urgent_only = false);
  void Return(const Loaded& loaded);

  const DeliveryCounters& counters(std::size_t channel) const { return counters_[channel]; }
  std::vector<EventReceiver>& events() { return events_; }
  const std::vector<EventReceiver>& events() const { return events_; }

 private:
  void Deliver(Delivery delivery, std::size_t bits, std::vector<Delivery>& out);

  const ChannelTable* table_;
  std::vector<EventReceiver> events_;       ///< by channel
  std::vector<MessageHistory> histories_;   ///< by channel: the baselines of differences
  std::vector<DeliveryCounters> counters_;  ///< by channel
  bool urgent_news_ = false;                ///< an urgent event came that is not acknowledged yet
  bool forget_due_ = false;                 ///< the other end uses a baseline that is not known here
};

}  // namespace priamos::bus::radio
