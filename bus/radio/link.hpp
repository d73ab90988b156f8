#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bus/radio/bundle.hpp"
#include "bus/radio/channel_table.hpp"
#include "bus/radio/cobs.hpp"
#include "bus/radio/delta.hpp"
#include "bus/radio/epoch.hpp"
#include "bus/radio/event_stream.hpp"
#include "bus/radio/frame.hpp"
#include "bus/radio/link_memory.hpp"
#include "bus/radio/link_quality.hpp"
#include "bus/radio/pacer.hpp"
#include "bus/radio/send_queue.hpp"
#include "bus/radio/turn_taking.hpp"

namespace priamos::bus::radio {

/// A message as it goes over the air.
struct Packed {
  std::vector<std::byte> bytes;
  std::size_t bits = 0;    ///< of `bytes`, from the first on
  bool saturated = false;  ///< a field was outside its range
};

/// Makes the encoded message of a channel small. It is asked when the message goes on the line, so that time
/// stamps travel as age at sending; nullopt when it is no message of the channel's type.
using PackFunction =
    std::function<std::optional<Packed>(std::size_t channel, std::span<const std::byte> encoded, Time now)>;

/// How an end uses the line.
struct LinkOptions {
  double bytes_per_s = 960;            ///< what the line carries, or the radio if that is slower
  int ahead_bytes = 2;                 ///< written ahead of the line, beside the byte being sent
  std::size_t max_bundle_bytes = 120;  ///< a longer message goes alone
  Duration keep_alive{250'000};        ///< silence is broken after this
  Duration silence{1'500'000};         ///< without a frame for so long the link is down
  Duration ageing{1'000'000};          ///< a waiting message gains one priority level per this
  HalfDuplex half_duplex{};            ///< by default the line has two directions
  bool datagrams = false;              ///< a frame goes whole, in one datagram, whose head counts as sent
};

/// A message from the other end.
struct Delivery {
  std::size_t channel = 0;
  std::vector<std::byte> packed;
  Time packed_at{};                   ///< when it was packed, in this end's clock: its ages count from here
  std::optional<Time> valid_until{};  ///< commands: not to be obeyed later
};

enum class OfferResult { kAccepted, kRefused, kNotOutgoing };

/// Counters of an end since it was made.
struct LinkCounters {
  std::uint64_t bytes_sent = 0;
  std::uint64_t bytes_received = 0;
  std::uint64_t bundle_bytes_sent = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_aborted = 0;   ///< by an urgent message
  std::uint64_t frames_received = 0;  ///< accepted data frames
  std::uint64_t frames_missed = 0;    ///< counters of the other end that never came
  std::uint64_t hellos_sent = 0;
  std::uint64_t hellos_received = 0;
  std::uint64_t bundles_damaged = 0;  ///< right code, but not readable: another version of the program
  std::array<std::uint64_t, kRejects> rejected{};
};

/// What arrived on one incoming channel.
struct DeliveryCounters {
  std::uint64_t delivered = 0;
  /// Refused: a command that may be too old, a message overtaken by a newer one, a difference to a message
  /// from before a restart.
  std::uint64_t late = 0;
  std::uint64_t bits = 0;
};

struct LinkStatus {
  bool up = false;
  bool agreed = false;          ///< there is an epoch
  bool alarm = false;           ///< frames that the other end cannot have sent: see ForgeryGuard
  bool table_mismatch = false;  ///< the other end has another channel table: nothing is exchanged
  Duration round_trip{-1};      ///< smoothed, event to acknowledgement; negative before the first
  Duration latency{};           ///< of the line, one way, estimated
  double loss = 0;              ///< share of the other end's frames that did not arrive, lately
  double peer_loss = 0;         ///< the same seen from the other end
  double bit_error_rate = 0;    ///< that explains `loss`
  std::uint64_t resent = 0;     ///< segments of events
  LinkCounters counters;
};

/// One end of the radio link: pure, time is an argument, bytes in and bytes out.
///
/// Offer() what is to be sent, call Step() every 1 or 2 ms and write what it returns to the line at once,
/// give Receive() what the line brought. Any frame of any start can be used at once; only an end that lost
/// its state waits for about 0.15 s (see EpochAgreement).
class LinkEndpoint {
 public:
  /// `store` must outlive the endpoint. `outgoing` tells which end this is: the onboard end sends kUp.
  LinkEndpoint(ChannelTable table, Direction outgoing, const LinkKey& key, const LinkOptions& options,
               StateStore& store, PackFunction pack, NonceSource nonces, Time now);
  LinkEndpoint(const LinkEndpoint&) = delete;
  LinkEndpoint& operator=(const LinkEndpoint&) = delete;

  /// An encoded message for an outgoing channel; messages with different keys do not replace each other.
  OfferResult Offer(std::size_t channel, std::span<const std::byte> encoded, Time now,
                    std::string_view key = {});
  /// Whether somebody listens here to an on-request channel of the other end.
  void Listen(std::size_t channel, bool listening);
  /// Whether somebody listens to an outgoing on-request channel on the other side.
  bool wanted(std::size_t channel) const { return queue_.wanted(channel); }

  /// The bytes that may be written to the line now.
  std::vector<std::byte> Step(Time now);
  /// What the bytes that came from the line make complete.
  std::vector<Delivery> Receive(std::span<const std::byte> bytes, Time now);
  /// Orderly end: saves the exact counters, so that the next start need not skip any.
  void Close();

  LinkStatus Status(Time now) const;
  const QueueCounters& sent(std::size_t channel) const { return queue_.counters(channel); }
  const DeliveryCounters& delivered(std::size_t channel) const { return deliveries_[channel]; }
  Duration OldestAge(std::size_t channel, Time now) const { return queue_.OldestAge(channel, now); }
  /// Events of a channel that are not acknowledged yet.
  std::size_t waiting(std::size_t channel) const { return queue_.events(channel).events().size(); }
  const ChannelTable& table() const { return table_; }
  Direction outgoing() const { return outgoing_; }

 private:
  struct SentSegment {
    std::size_t channel;
    std::uint8_t number;
  };
  struct SentMessage {
    QueuedMessage message;
    std::size_t bits;               ///< on the line
    std::vector<std::byte> packed;  ///< what the other end will have; of channels with differences
  };
  /// The frame on its way out, and what must be undone when it is aborted.
  struct Flight {
    std::vector<std::byte> wire;
    std::size_t next = 0;
    std::uint64_t counter = 0;  ///< 0: a hello
    bool urgent = false;        ///< never cut off
    bool repeats = false;       ///< only what was urgent before: cut off by what is urgent now
    bool over = false;          ///< ends the turn
    std::size_t bundle_bytes = 0;
    std::vector<SentMessage> messages;
    std::vector<SentSegment> segments;
    std::vector<std::size_t> acks;
    bool frame_ack = false;
    bool listen = false;
    bool forget = false;
  };
  struct SentFrame {
    std::uint64_t counter;
    Time end;
  };

  // link_send.cpp
  bool BuildFrame(Time now);
  void BuildHello(Time now);
  void BuildData(Time now, bool urgent_only);
  void AddOver(Time now, BitWriter& bundle, Flight& flight) const;
  void Launch(Flight flight, std::vector<std::byte> wire, Time now);
  bool MaySend(Time now) const;
  /// Time of a frame's bytes on the line; a datagram arrives at once.
  Duration OnTheWay(std::size_t bytes) const;
  Time LeavesAt(std::size_t bytes, Time now) const;
  bool DataDue(Time now) const;
  bool AckDue() const;
  bool HelloDue(Time now) const;
  bool FrameAckDue(Time now) const;
  void AddControl(Time now, BitWriter& bundle, Flight& flight);
  void AddMessages(Time now, bool urgent_only, BitWriter& bundle, Flight& flight);
  void AddSegments(std::size_t channel, Time now, bool urgent_only, BitWriter& bundle, Flight& flight);
  bool AddSegment(std::size_t channel, Time now, BitWriter& bundle, Flight& flight);
  void AddNewest(const SendQueue::Candidate& candidate, Time now, BitWriter& bundle, Flight& flight);
  BundleEntry NewestEntry(const SendQueue::Candidate& candidate, const Packed& packed, Time now) const;
  bool AddEntry(const BundleEntry& entry, BitWriter& bundle, const Flight& flight) const;
  std::size_t BundleTarget() const;
  CounterForm FormOf(std::uint64_t counter) const;
  void Abort(Time now, std::vector<std::byte>& out);
  void Emit(std::byte byte, Time now, std::vector<std::byte>& out);
  void Finish();

  // link.cpp
  void OnFrame(std::span<const std::byte> encoded, Time now, std::vector<Delivery>& out);
  void OnData(const DataFrame& frame, std::uint64_t highest_before, std::size_t wire_bytes, Time now,
              std::vector<Delivery>& out);
  void OnEntry(BundleEntry entry, bool newest, std::size_t wire_bytes, Time now, std::vector<Delivery>& out);
  void OnHello(const Hello& hello, Time now);
  void OnReject(Reject reject, Time now);
  void NoteInTurn(std::uint64_t ahead);
  Time SentAt(std::size_t wire_bytes, Time now) const;
  void OnFrameAck(const FrameAckEntry& ack, std::size_t wire_bytes, Time now);
  void OnEventAck(const EventAckEntry& entry, Time now);
  void OnEvent(const EventEntry& entry, Time sent_at, std::vector<Delivery>& out);
  void OnState(StateEntry entry, bool newest, Time sent_at, std::vector<Delivery>& out);
  void OnCommand(CommandEntry entry, bool newest, Time sent_at, Time now, std::vector<Delivery>& out);
  void OnListen(const ListenEntry& listen, Time now);
  void SetWanted(std::uint64_t channels);
  void ChangeEpoch(const EpochAgreement::Pair& pair, std::uint32_t peer_stream);
  bool Down(Time now) const { return !last_valid_ || now - *last_valid_ > options_.silence; }
  /// The other end's frames cannot be used although they come.
  bool Needy(Time now) const;

  ChannelTable table_;
  Direction outgoing_;
  LinkOptions options_;
  PackFunction pack_;
  FrameKeys keys_;
  FrameSealer sealer_;
  FrameOpener opener_;
  FrameSplitter splitter_;
  Time frame_began_;  ///< arrival of the first byte of the frame that is coming in
  LinkMemory memory_;
  EpochAgreement agreement_;
  SendQueue queue_;
  std::vector<EventReceiver> receivers_;
  std::vector<DeliveryCounters> deliveries_;
  std::vector<DeltaSender> delta_senders_;
  std::vector<MessageHistory> delta_received_;  ///< what differences may refer to

  Pacer pacer_;
  TurnTaking turns_;
  std::optional<Flight> flight_;
  std::optional<std::uint64_t> confirmed_;  ///< highest counter that the other end reported
  std::deque<SentFrame> sent_frames_;       ///< the last ones, for round trips
  Time last_data_;                          ///< begin of the last data frame sent
  Time last_hello_;
  std::optional<Time> last_listen_;
  std::optional<Time> wanted_until_;  ///< the other end's listeners are believed until then
  bool hello_reply_ = false;
  AnswerLimit hello_limit_;
  bool switched_ = false;   ///< to a new epoch, of which no frame has come yet
  bool floor_due_ = false;  ///< the other end may still send counters that count as used here
  std::uint64_t listening_ = 0;
  bool listen_due_ = false;
  bool forget_due_ = false;  ///< the other end refers to what is not known here

  std::optional<Time> last_valid_;  ///< arrival of the last accepted data frame
  std::optional<Time> last_frame_ack_;
  std::optional<Time> proven_;  ///< when the newest own frame was sent that the other end had heard
  std::uint64_t in_turn_ = 0;   ///< bit i: the frame i before the highest was accepted before any later one
  std::uint64_t frames_since_ack_ = 0;
  std::uint64_t bad_since_valid_ = 0;
  RoundTrip round_trip_;
  LatencyMeter latency_;
  LossMeter loss_;
  ForgeryGuard guard_;
  double peer_loss_ = 0;
  bool table_mismatch_ = false;
  LinkCounters counters_;
};

}  // namespace priamos::bus::radio
