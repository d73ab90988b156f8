#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/frame_receiver.hpp"
#include "bus/radio/frame_scheduler.hpp"
#include "bus/radio/link_memory.hpp"
#include "bus/radio/link_options.hpp"
#include "bus/radio/message_receiver.hpp"
#include "bus/radio/message_sender.hpp"
#include "bus/radio/peer.hpp"

namespace priamos::bus::radio {

/// Counters of an end since it was made.
struct LinkCounters {
  std::uint64_t bytes_sent = 0;
  std::uint64_t bytes_received = 0;
  std::uint64_t bundle_bytes_sent = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_aborted = 0;   ///< frames cut off by an urgent message
  std::uint64_t frames_received = 0;  ///< data frames accepted
  std::uint64_t frames_missed = 0;    ///< counters of the other end that never came
  std::uint64_t hellos_sent = 0;
  std::uint64_t hellos_received = 0;
  std::uint64_t bundles_damaged = 0;  ///< right code, but not readable: another version of the program
  std::array<std::uint64_t, kRejects> rejected{};
};

/// What a frame proves of the place that it came from.
enum class Proof : std::uint8_t {
  kNone,     ///< nothing
  kGenuine,  ///< the other end made it, and anybody may have kept and repeated it
  kFresh     ///< the other end made it just now: it is there, or somebody who passes its frames on
};

/// What came of a frame.
struct Received {
  std::vector<Delivery> deliveries;
  Proof proof = Proof::kNone;
};

/// How far the link's change to the next key is.
enum class KeyChange : std::uint8_t {
  kNone,     ///< neither end has said that it has a next key
  kWaiting,  ///< this end has one, and has not heard that the other end has it
  kOffered,  ///< the other end has one, this one has none
  kDiffers,  ///< the ends have different ones: nothing changes
  kDone      ///< the next key is in use, and the one before it opens nothing
};

/// What an end of a shared channel has to say that should not wait for its next poll.
enum class Need : std::uint8_t {
  kNothing,
  kCommand,  ///< a command waits, which a recent frame of the robot has to prove fresh
  kAnswer,   ///< an urgent event was sent and is not acknowledged
  kUrgent    ///< an urgent event waits
};

/// State of the link.
struct LinkStatus {
  bool up = false;
  bool agreed = false;          ///< both ends have agreed on an epoch
  bool alarm = false;           ///< frames came that the other end cannot have sent: see ForgeryGuard
  bool table_mismatch = false;  ///< the other end has another channel table: nothing is exchanged
  KeyChange key_change = KeyChange::kNone;
  std::size_t peer_code_bytes = 0;  ///< length of the other end's codes by its last hello; 0 before
  Duration round_trip{-1};          ///< from event to acknowledgement, smoothed; negative before the first
  Duration latency{};               ///< delay of the line, one way, estimated
  double loss = 0;                  ///< share of the other end's frames that did not arrive, lately
  double peer_loss = 0;             ///< share of this end's frames that did not arrive there, lately
  double bit_error_rate = 0;        ///< probability per bit that explains `loss`
  std::uint64_t resent = 0;         ///< segments of events that were sent again
  LinkCounters counters;
};

/// One end of the radio link: pure, time is an argument, bytes in and bytes out.
///
/// Pass messages to Offer(), call Step() every 1 or 2 ms and write what it returns to the line at once, and
/// pass the bytes from the line to Receive(). That commands are fresh is counted from these times: that of
/// Step() must not be after its bytes are written, that of Receive() not before its bytes were read. After a
/// restart frames can be used at once; only an end that lost its state waits for about 0.15 s (see
/// EpochAgreement).
///
/// It only joins its parts, each of which can be read alone: FrameReceiver (bytes to frames), MessageReceiver
/// (frames to messages), Peer (what the ends report to each other), MessageSender (messages to bundles),
/// FrameScheduler (bundles to bytes) and LinkMemory (what outlives the process).
class LinkEndpoint {
 public:
  /// End of a link; `store` must outlive it. `outgoing` is kUp at the onboard end, kDown at the other one.
  /// `next_key`: the key that it is ready to change to, together with the other end, see NextKey.
  LinkEndpoint(ChannelTable table, Direction outgoing, const LinkKey& key, const LinkOptions& options,
               StateStore& store, PackFunction pack, NonceSource nonces, Time now,
               const std::optional<LinkKey>& next_key = {});
  LinkEndpoint& operator=(const LinkEndpoint&) = delete;
  /// An independent copy of this end in the same state, with its own memory, for a search over possible
  /// futures. What `store` holds must be a copy of what the store of this end holds.
  LinkEndpoint Fork(StateStore& store) const;

  /// An encoded message for an outgoing channel; messages with different keys do not replace each other.
  /// `made`: when a command was made, if it took its time until now; its time-to-live counts from there.
  OfferResult Offer(std::size_t channel, std::span<const std::byte> encoded, Time now,
                    std::string_view key = {}, std::optional<Time> made = {});
  /// Reports whether this end has a listener for an on-request channel of the other end.
  void Listen(std::size_t channel, bool listening) { peer_.listeners.Listen(channel, listening); }
  /// Whether the other end has a listener for an outgoing on-request channel.
  bool wanted(std::size_t channel) const { return outbox_.queue().wanted(channel); }

  /// Notes that what had arrived on the line by `now` was read and passed on. Where ends take turns, it tells
  /// when a poll can have come at the earliest, should this process have stood still before it read it.
  /// Without it bytes count as come when they are passed on.
  void OnLook(Time now) { scheduler_.OnLook(now); }
  /// The bytes that may be written to the line now.
  std::vector<std::byte> Step(Time now);
  /// The messages that the bytes from the line make complete.
  std::vector<Delivery> Receive(std::span<const std::byte> bytes, Time now);
  /// The same for a whole frame, without its delimiter, which came beside the others: see
  /// FrameReceiver::Take.
  Received ReceiveFrame(std::span<const std::byte> frame, Time first_byte, Time now, bool stranger);
  /// Ends in order: saves the exact counters, so that the next start need not skip any.
  void Close();

  /// What a station should know before it grants this end a turn.
  Need need(Time now) const;
  /// The turns of this end, which its station grants, on a channel that several robots share.
  TurnTaking& turns() { return scheduler_.turns(); }
  /// When the bytes of Step() have left.
  Time line_free() const { return scheduler_.line_free(); }

  LinkStatus Status(Time now) const;
  const QueueCounters& sent(std::size_t channel) const { return outbox_.queue().counters(channel); }
  const DeliveryCounters& delivered(std::size_t channel) const { return inbox_.counters(channel); }
  Duration OldestAge(std::size_t channel, Time now) const { return outbox_.queue().OldestAge(channel, now); }
  /// Number of events of a channel that are not acknowledged yet.
  std::size_t waiting(std::size_t channel) const { return outbox_.queue().events(channel).events().size(); }
  const ChannelTable& table() const { return *table_; }
  Direction outgoing() const { return outgoing_; }

 private:
  LinkEndpoint(const LinkEndpoint&) = default;  // for Fork: a plain copy would share the store

  Proof OnResult(const FrameReceiver::Result& result, Time now, std::vector<Delivery>& out);
  Proof OnHello(const Hello& hello, Time now);
  Proof OnNextKeyHello(const Hello& hello, Time now);
  void OnFresh(const Hello& hello, Time now);
  void AwaitNextKey(const LinkKey& key, const LinkOptions& options, NonceSource nonces, Time now);
  void UseNextKey();
  KeyChange key_change() const;
  void OnFrame(const AcceptedFrame& accepted, Time now, std::vector<Delivery>& out);
  Arrival ArrivalOf(const AcceptedFrame& accepted, Time now) const;
  void OnEntry(BundleEntry entry, const Arrival& arrival, std::vector<Delivery>& out);
  void OnFrameAck(const FrameAckEntry& ack, Time began);
  void SetWanted(std::uint64_t channels);
  void ChangeEpoch(const EpochAgreement::Pair& pair, std::uint32_t peer_stream);
  void StoreEvents() { memory_.StoreEvents(outbox_.queue(), inbox_.events()); }

  std::shared_ptr<const ChannelTable> table_;  ///< shared with forks, whose parts refer to it, too
  Direction outgoing_;
  LinkMemory memory_;
  FrameKeys keys_;    ///< in use
  bool key_changed_;  ///< to the next one, in this life or before
  FrameReceiver receiver_;
  MessageReceiver inbox_;
  Peer peer_;
  MessageSender outbox_;
  FrameScheduler scheduler_;
  bool events_changed_ = false;  ///< since they were stored
  std::uint64_t bundles_damaged_ = 0;
};

}  // namespace priamos::bus::radio
