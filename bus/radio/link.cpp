#include "bus/radio/link.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {
namespace {

/// One COBS code byte before the longest content.
constexpr std::size_t kMaxEncodedBytes = 1 + 1 + kWholeCounterBytes + kMaxBundleBytes + 4;
/// So many unusable frames in a row are no accident.
constexpr std::uint64_t kNeedyAfter = 3;
/// Acknowledgements of frames come a few times per second, and get lost now and then.
constexpr Duration kProofSlack{1'000'000};
/// An end without an epoch asks at once; one with an epoch first gives its frames a chance.
constexpr Duration kHelloPause{300'000};
/// Listeners say every 2 s that they still listen.
constexpr Duration kListenMemory{6'000'000};

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

LinkEndpoint::LinkEndpoint(ChannelTable table, Direction outgoing, const LinkKey& key,
                           const LinkOptions& options, StateStore& store, PackFunction pack,
                           NonceSource nonces, Time now)
    : table_(std::move(table)),
      outgoing_(outgoing),
      options_(options),
      pack_(std::move(pack)),
      keys_(key),
      sealer_(keys_, outgoing, {table_.hash(), table_.encrypted()}),
      opener_(keys_, Opposite(outgoing), {table_.hash(), table_.encrypted()}),
      splitter_(kMaxEncodedBytes),
      frame_began_(now),
      memory_(store, table_, nonces),
      agreement_(nonces),
      queue_(table_, outgoing, options.ageing),
      receivers_(table_.size()),
      deliveries_(table_.size()),
      delta_senders_(table_.size()),
      delta_received_(table_.size()),
      pacer_(options.bytes_per_s, options.ahead_bytes, now),
      turns_(options.half_duplex, outgoing == Direction::kUp, now),
      last_data_(now - options.keep_alive),
      last_hello_(now - kHelloPause),
      hello_limit_(now),
      floor_due_(memory_.epoch() != 0 && !memory_.floor_exact()),
      guard_(options.bytes_per_s / kFrameOverhead, now) {
  opener_.SetEpoch(memory_.epoch(), memory_.receive_floor());
  memory_.RestoreEvents(queue_, receivers_);
}

OfferResult LinkEndpoint::Offer(std::size_t channel, std::span<const std::byte> encoded, Time now,
                                std::string_view key) {
  if (channel >= table_.size() || table_.at(channel).direction != outgoing_) return OfferResult::kNotOutgoing;
  if (table_.at(channel).channel_class != ChannelClass::kEvent)
    return queue_.Offer(channel, key, encoded, now) ? OfferResult::kAccepted : OfferResult::kRefused;
  auto packed = pack_(channel, encoded, now);
  if (!packed) {
    queue_.CountRefused(channel);
    return OfferResult::kRefused;
  }
  if (packed->saturated) ++queue_.counters(channel).saturated;
  if (!queue_.OfferEvent(channel, std::move(packed->bytes), packed->bits, now)) return OfferResult::kRefused;
  memory_.StoreEvents(queue_, receivers_);
  return OfferResult::kAccepted;
}

void LinkEndpoint::Listen(std::size_t channel, bool listening) {
  const std::uint64_t before = listening_;
  const std::uint64_t bit = std::uint64_t{1} << channel;
  listening_ = listening ? listening_ | bit : listening_ & ~bit;
  if (listening_ != before) listen_due_ = true;
}

std::vector<Delivery> LinkEndpoint::Receive(std::span<const std::byte> bytes, Time now) {
  std::vector<Delivery> deliveries;
  counters_.bytes_received += bytes.size();
  if (!bytes.empty()) turns_.OnBytes(now);
  for (const std::byte b : bytes) {
    if (splitter_.between_frames()) frame_began_ = now;
    switch (splitter_.Push(b)) {
      case FrameSplitter::Event::kNone:
        break;
      case FrameSplitter::Event::kFrame:
        OnFrame(splitter_.frame(), now, deliveries);
        break;
      case FrameSplitter::Event::kOversize:
        OnReject(Reject::kOversize, now);
        break;
    }
  }
  return deliveries;
}

void LinkEndpoint::Close() {
  memory_.StoreEvents(queue_, receivers_);
  memory_.Close(opener_.highest());
}

void LinkEndpoint::OnFrame(std::span<const std::byte> encoded, Time now, std::vector<Delivery>& out) {
  if (!guard_.MayTry(now)) return OnReject(Reject::kFlood, now);
  const std::uint64_t highest_before = opener_.highest();
  const Opened opened = opener_.Open(encoded);
  if (const auto* reject = std::get_if<Reject>(&opened)) return OnReject(*reject, now);
  if (const auto* hello = std::get_if<Hello>(&opened)) return OnHello(*hello, now);
  OnData(std::get<DataFrame>(opened), highest_before, encoded.size() + 1, now, out);
}

void LinkEndpoint::OnReject(Reject reject, Time now) {
  ++counters_.rejected[static_cast<std::size_t>(reject)];
  if (reject == Reject::kBadCode || reject == Reject::kReplayed) ++bad_since_valid_;
  if (reject == Reject::kBadCode) guard_.OnBadCode(now);
  if (reject == Reject::kReplayed) guard_.OnReplay(now);
}

void LinkEndpoint::OnData(const DataFrame& frame, std::uint64_t highest_before, std::size_t wire_bytes,
                          Time now, std::vector<Delivery>& out) {
  memory_.NoteAccepted(opener_.highest());
  // After its own start an end cannot know what it missed.
  const std::uint64_t missed =
      last_valid_ && frame.counter > highest_before ? frame.counter - highest_before - 1 : 0;
  counters_.frames_missed += missed;
  guard_.OnMissed(missed);
  loss_.OnFrame(missed, wire_bytes);
  if (Down(now)) {
    for (std::size_t i = 0; i < table_.size(); ++i) queue_.events(i).ResendAll(false);
    last_frame_ack_.reset();  // the other end waits for it, to know that commands are fresh
  }
  ++counters_.frames_received;
  ++frames_since_ack_;
  last_valid_ = now;
  bad_since_valid_ = 0;
  switched_ = false;
  floor_due_ = false;
  table_mismatch_ = false;
  ParsedBundle bundle = ParseBundle(table_, Opposite(outgoing_), frame.bundle);
  if (!bundle.whole) ++counters_.bundles_damaged;
  const bool newest = frame.counter > highest_before;
  if (newest) NoteInTurn(frame.counter - highest_before);
  for (BundleEntry& entry : bundle.entries) OnEntry(std::move(entry), newest, wire_bytes, now, out);
}

/// Frames that others overtook are not noted: states in them were dropped.
void LinkEndpoint::NoteInTurn(std::uint64_t ahead) {
  in_turn_ = (ahead < 64 ? in_turn_ << ahead : 0) | 1U;
}

/// When a frame that is complete now began to be sent. Its bytes need not have come one after the other: when
/// a cut swallowed only the delimiter, the next one, however late, completes the frame.
Time LinkEndpoint::SentAt(std::size_t wire_bytes, Time now) const {
  return std::min(now - OnTheWay(wire_bytes), frame_began_ - OnTheWay(1)) - latency_.one_way();
}

void LinkEndpoint::OnEntry(BundleEntry entry, bool newest, std::size_t wire_bytes, Time now,
                           std::vector<Delivery>& out) {
  const Time sent_at = SentAt(wire_bytes, now);
  std::visit(Overloaded{[&](StateEntry& e) { OnState(std::move(e), newest, sent_at, out); },
                        [&](CommandEntry& e) { OnCommand(std::move(e), newest, sent_at, now, out); },
                        [&](EventEntry& e) { OnEvent(e, sent_at, out); },
                        [&](EventAckEntry& e) { OnEventAck(e, now); },
                        [&](FrameAckEntry& e) { OnFrameAck(e, wire_bytes, now); },
                        [&](FloorEntry& e) {
                          memory_.SkipCounters(e.counter);
                          confirmed_.reset();
                        },
                        [&](ListenEntry& e) { OnListen(e, now); },
                        [&](OverEntry&) {
                          if (newest) turns_.OnOverReceived(now);
                        },
                        [&](ForgetEntry&) {
                          for (DeltaSender& sender : delta_senders_) sender.Forget();
                        }},
             entry);
}

void LinkEndpoint::OnState(StateEntry entry, bool newest, Time sent_at, std::vector<Delivery>& out) {
  const ValueWidths& widths = table_.at(entry.channel).delta;
  MessageHistory& history = delta_received_[entry.channel];
  if (newest && entry.baseline) {
    const auto* baseline = history.Find(BaselineCounter(opener_.highest(), *entry.baseline));
    auto whole = baseline != nullptr ? ApplyDelta(widths, baseline->packed, entry.packed) : std::nullopt;
    forget_due_ = forget_due_ || !whole;
    newest = whole.has_value();
    if (whole) entry.packed = std::move(*whole);
  }
  if (!newest) {
    ++deliveries_[entry.channel].late;
    return;
  }
  if (!widths.empty()) history.Note(opener_.highest(), entry.packed);
  ++deliveries_[entry.channel].delivered;
  deliveries_[entry.channel].bits += entry.bits;
  out.push_back({entry.channel, std::move(entry.packed), sent_at});
}

void LinkEndpoint::OnCommand(CommandEntry entry, bool newest, Time sent_at, Time now,
                             std::vector<Delivery>& out) {
  const Duration ttl = table_.at(entry.channel).ttl;
  const Time valid_until = sent_at - entry.age + ttl;
  // A modem, or somebody, may have held the frame back. It is not older than the newest frame from here that
  // the other end had heard when it was made.
  const bool fresh = proven_ && now - *proven_ <= ttl + kProofSlack;
  if (!newest || !fresh || valid_until < now) {
    ++deliveries_[entry.channel].late;
    return;
  }
  ++deliveries_[entry.channel].delivered;
  deliveries_[entry.channel].bits += entry.bits;
  out.push_back({entry.channel, std::move(entry.packed), sent_at, valid_until});
}

void LinkEndpoint::OnEvent(const EventEntry& entry, Time sent_at, std::vector<Delivery>& out) {
  EventReceiver& receiver = receivers_[entry.channel];
  const bool known = receiver.known();
  auto events = receiver.OnSegment(entry.segment, sent_at);
  if (events.empty() && receiver.known() == known) return;
  for (EventReceiver::Event& event : events) {
    ++deliveries_[entry.channel].delivered;
    deliveries_[entry.channel].bits += event.bits;
    out.push_back({entry.channel, std::move(event.packed), event.packed_at});
  }
  // Before the acknowledgement can leave: a restarted end must not deliver them again.
  memory_.StoreEvents(queue_, receivers_);
}

void LinkEndpoint::OnEventAck(const EventAckEntry& entry, Time now) {
  EventSender& sender = queue_.events(entry.channel);
  const std::size_t done = sender.OnAck(entry.ack, now, round_trip_);
  for (std::size_t i = 0; i < table_.size(); ++i) queue_.events(i).set_timeout(round_trip_.timeout());
  queue_.counters(entry.channel).sent += done;
  if (done > 0) memory_.StoreEvents(queue_, receivers_);
}

void LinkEndpoint::OnFrameAck(const FrameAckEntry& ack, std::size_t wire_bytes, Time now) {
  peer_loss_ = ack.loss;
  for (const SentFrame& sent : sent_frames_) {
    const std::uint64_t back = (ack.counter - sent.counter) & 0xFFFU;
    if (back > kEarlierFrames || (back > 0 && (ack.earlier >> (back - 1) & 1U) == 0)) continue;
    for (DeltaSender& sender : delta_senders_) sender.OnAcknowledged(sent.counter);
    if (back > 0) continue;
    confirmed_ = std::max(confirmed_.value_or(0), sent.counter);
    proven_ = std::max(proven_.value_or(sent.end), sent.end);
    latency_.Sample(now - sent.end - ack.hold - OnTheWay(wire_bytes));
  }
}

void LinkEndpoint::OnListen(const ListenEntry& listen, Time now) {
  if (listen.channels != 0) wanted_until_ = now + kListenMemory;
  SetWanted(listen.channels);
}

void LinkEndpoint::SetWanted(std::uint64_t channels) {
  for (std::size_t i = 0; i < table_.size(); ++i)
    if (table_.at(i).on_request && table_.at(i).direction == outgoing_)
      queue_.SetWanted(i, (channels >> i & 1U) != 0);
}

void LinkEndpoint::OnHello(const Hello& hello, Time now) {
  ++counters_.hellos_received;
  if (hello.over) turns_.OnOverReceived(now);
  table_mismatch_ = hello.table_hash != table_.hash();
  if (table_mismatch_) return;
  const EpochAgreement::Outcome outcome = agreement_.OnHello(hello);
  if (outcome.agreed) ChangeEpoch(*outcome.agreed, hello.stream);
  hello_reply_ = hello_reply_ || outcome.reply;
}

void LinkEndpoint::ChangeEpoch(const EpochAgreement::Pair& pair, std::uint32_t peer_stream) {
  const bool onboard = outgoing_ == Direction::kUp;
  const std::uint64_t epoch = keys_.EpochOf(onboard ? pair.own : pair.peer, onboard ? pair.peer : pair.own);
  if (memory_.ChangeEpoch(epoch, peer_stream))
    for (EventReceiver& receiver : receivers_) receiver.Forget();
  opener_.SetEpoch(epoch, 0);
  for (std::size_t i = 0; i < table_.size(); ++i) queue_.events(i).ResendAll(true);
  for (DeltaSender& sender : delta_senders_) sender.Forget();
  for (MessageHistory& history : delta_received_) history.Clear();
  confirmed_ = 0;
  proven_.reset();
  sent_frames_.clear();
  frames_since_ack_ = 0;
  in_turn_ = 0;
  switched_ = true;
  floor_due_ = false;
}

bool LinkEndpoint::Needy(Time now) const {
  return memory_.epoch() == 0 || (Down(now) && bad_since_valid_ >= kNeedyAfter);
}

LinkStatus LinkEndpoint::Status(Time now) const {
  LinkStatus status{.up = !Down(now),
                    .agreed = memory_.epoch() != 0,
                    .alarm = guard_.alarm(now),
                    .table_mismatch = table_mismatch_,
                    .round_trip = round_trip_.smoothed(),
                    .latency = latency_.one_way(),
                    .loss = loss_.loss(),
                    .peer_loss = peer_loss_,
                    .bit_error_rate = loss_.BitErrorRate(),
                    .resent = 0,
                    .counters = counters_};
  for (std::size_t i = 0; i < table_.size(); ++i) status.resent += queue_.events(i).resent();
  return status;
}

}  // namespace priamos::bus::radio
