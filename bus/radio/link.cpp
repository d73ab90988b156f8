#include "bus/radio/link.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {
namespace {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

FrameScope ScopeOf(const ChannelTable& table, Direction direction, const LinkOptions& options) {
  return {.table_hash = table.hash(),
          .encrypted = table.encrypted(),
          .echo_bytes = table.HasCommands(direction) ? EchoBytes(options.bytes_per_s) : 0,
          .code_bytes = table.code_bytes(),
          .address = options.address};
}

/// Whether the other end must skip counters: this end does not know which of those reserved were used.
bool FloorDue(const LinkMemory& memory) {
  return memory.epoch() != 0 && !memory.floor_exact();
}

KeyChecks ChecksOf(const LinkKey& key, const std::optional<LinkKey>& next_key) {
  return {.current = KeyCheck(key), .next = next_key ? KeyCheck(*next_key) : 0};
}

}  // namespace

LinkEndpoint::LinkEndpoint(ChannelTable table, Direction outgoing, const LinkKey& key,
                           const LinkOptions& options, StateStore& store, PackFunction pack,
                           NonceSource nonces, Time now, const std::optional<LinkKey>& next_key)
    : table_(std::make_shared<const ChannelTable>(std::move(table))),
      outgoing_(outgoing),
      memory_(store, *table_, nonces, ChecksOf(key, next_key)),
      keys_(memory_.under_next_key() ? *next_key : key),
      key_changed_(memory_.under_next_key()),
      receiver_(keys_, Opposite(outgoing), ScopeOf(*table_, Opposite(outgoing), options), options.bytes_per_s,
                options.silence, now),
      inbox_(*table_),
      peer_{.handshake = Handshake(table_->hash(), nonces, FloorDue(memory_), now, table_->code_bytes())},
      outbox_(*table_, outgoing, options.ageing, std::move(pack)),
      scheduler_(*table_, FrameSealer(keys_, outgoing, ScopeOf(*table_, outgoing, options)), options,
                 outgoing == Direction::kUp, now) {
  receiver_.SetEpoch(memory_.epoch(), memory_.receive_floor());
  memory_.RestoreEvents(outbox_.queue(), inbox_.events());
  if (next_key && !key_changed_) AwaitNextKey(*next_key, options, std::move(nonces), now);
}

void LinkEndpoint::AwaitNextKey(const LinkKey& key, const LinkOptions& options, NonceSource nonces,
                                Time now) {
  const FrameKeys keys(key);
  const Direction incoming = Opposite(outgoing_);
  receiver_.SetNextKey(FrameOpener(keys, incoming, ScopeOf(*table_, incoming, options)));
  peer_.next_key.emplace(KeyCheck(key), keys,
                         FrameSealer(keys, outgoing_, ScopeOf(*table_, outgoing_, options)),
                         Handshake(table_->hash(), std::move(nonces), false, now, table_->code_bytes()));
}

LinkEndpoint LinkEndpoint::Fork(StateStore& store) const {
  LinkEndpoint fork(*this);
  fork.memory_.MoveTo(store);
  return fork;
}

OfferResult LinkEndpoint::Offer(std::size_t channel, std::span<const std::byte> encoded, Time now,
                                std::string_view key, std::optional<Time> made) {
  const OfferResult result = outbox_.Offer(channel, encoded, now, key, made);
  if (result == OfferResult::kAccepted && table_->at(channel).channel_class == ChannelClass::kEvent)
    StoreEvents();
  return result;
}

std::vector<std::byte> LinkEndpoint::Step(Time now) {
  // Before an acknowledgement leaves, and after the events of Receive() were handed on: if the process ends
  // in between, they come a second time, and none is lost.
  if (std::exchange(events_changed_, false)) StoreEvents();
  outbox_.queue().Expire(now);
  if (peer_.listeners.TakeExpiry(now)) SetWanted(0);
  return scheduler_.Step({memory_, receiver_, peer_, inbox_, outbox_}, now);
}

std::vector<Delivery> LinkEndpoint::Receive(std::span<const std::byte> bytes, Time now) {
  std::vector<Delivery> deliveries;
  if (!bytes.empty()) scheduler_.OnBytes(now);
  for (const std::byte byte : bytes)
    OnResult(receiver_.Push(byte, now, memory_.last_counter()), now, deliveries);
  return deliveries;
}

Received LinkEndpoint::ReceiveFrame(std::span<const std::byte> frame, Time first_byte, Time now,
                                    bool stranger) {
  if (!stranger) scheduler_.OnBytes(now);
  Received received;
  const FrameReceiver::Result result =
      receiver_.Take(frame, first_byte, now, memory_.last_counter(), stranger);
  received.proof = OnResult(result, now, received.deliveries);
  return received;
}

Proof LinkEndpoint::OnResult(const FrameReceiver::Result& result, Time now, std::vector<Delivery>& out) {
  if (const auto* hello = std::get_if<Hello>(&result)) return OnHello(*hello, now);
  if (const auto* next = std::get_if<NextKeyHello>(&result)) return OnNextKeyHello(next->hello, now);
  const auto* accepted = std::get_if<AcceptedFrame>(&result);
  if (accepted == nullptr) return Proof::kNone;
  OnFrame(*accepted, now, out);
  return accepted->ahead > 0 ? Proof::kFresh : Proof::kGenuine;
}

Need LinkEndpoint::need(Time now) const {
  const SendQueue& queue = outbox_.queue();
  if (memory_.epoch() == 0) return Need::kNothing;
  if (queue.UrgentReady(now)) return Need::kUrgent;
  if (queue.UrgentUnanswered()) return Need::kAnswer;
  const auto ready = queue.Ready(now);
  const bool command = std::any_of(ready.begin(), ready.end(), [&](const SendQueue::Candidate& c) {
    return table_->at(c.channel).channel_class == ChannelClass::kCommand;
  });
  return command ? Need::kCommand : Need::kNothing;
}

void LinkEndpoint::Close() {
  StoreEvents();
  memory_.Close(receiver_.highest());
}

Proof LinkEndpoint::OnHello(const Hello& hello, Time now) {
  const Handshake::Proof proof = peer_.handshake.OnHello(hello, !receiver_.Down(now));
  // A robot without an epoch can prove nothing fresh before it was let speak: a replay may make it answer.
  if (!proof.fresh && hello.over && scheduler_.turns().shared()) scheduler_.OnOver(now);
  if (!proof.fresh) return Proof::kGenuine;
  OnFresh(hello, now);
  if (proof.agreed) ChangeEpoch(*proof.agreed, hello.stream);
  return Proof::kFresh;
}

/// Data goes on under the current key until this hello proves that the other end agrees on an epoch under
/// the next one. The other end follows with the answer.
Proof LinkEndpoint::OnNextKeyHello(const Hello& hello, Time now) {
  const Handshake::Proof proof = peer_.next_key->OnHello(hello, now);
  if (!proof.fresh && hello.over && scheduler_.turns().shared()) scheduler_.OnOver(now);
  if (!proof.fresh) return Proof::kGenuine;
  OnFresh(hello, now);
  if (!proof.agreed) return Proof::kFresh;
  UseNextKey();
  ChangeEpoch(*proof.agreed, hello.stream);
  return Proof::kFresh;
}

void LinkEndpoint::OnFresh(const Hello& hello, Time now) {
  scheduler_.OnFrame(now);
  if (hello.over) scheduler_.OnOver(now);
}

void LinkEndpoint::UseNextKey() {
  keys_ = peer_.next_key->keys();
  memory_.UseKey(peer_.next_key->check());
  receiver_.UseNextKey();
  scheduler_.SetSealer(peer_.next_key->sealer());
  peer_.UseNextKey();
  key_changed_ = true;
}

KeyChange LinkEndpoint::key_change() const {
  if (key_changed_) return KeyChange::kDone;
  const auto& announced = peer_.announced_key;
  if (!peer_.next_key) return announced ? KeyChange::kOffered : KeyChange::kNone;
  const bool differs = announced && *announced != peer_.next_key->check();
  return differs ? KeyChange::kDiffers : KeyChange::kWaiting;
}

void LinkEndpoint::OnFrame(const AcceptedFrame& accepted, Time now, std::vector<Delivery>& out) {
  memory_.NoteAccepted(receiver_.highest());
  scheduler_.OnFrame(now);
  if (accepted.link_back) {
    outbox_.OnLinkBack();
    peer_.acks.MakeDue();
  }
  peer_.acks.OnFrame(accepted.ahead);
  peer_.handshake.OnData();
  ParsedBundle bundle = ParseBundle(*table_, Opposite(outgoing_), accepted.frame.bundle);
  if (!bundle.whole) ++bundles_damaged_;
  // Each entry anew: an acknowledgement among them may correct the delay of the line.
  for (BundleEntry& entry : bundle.entries) OnEntry(std::move(entry), ArrivalOf(accepted, now), out);
}

/// The bytes of a frame need not have come one after the other: when a cut swallowed only the delimiter, the
/// next one, however late, completes the frame.
Arrival LinkEndpoint::ArrivalOf(const AcceptedFrame& accepted, Time now) const {
  const Time began = now - scheduler_.OnTheWay(accepted.wire_bytes);
  const Time first_byte = accepted.first_byte - scheduler_.OnTheWay(1);
  return {.counter = accepted.frame.counter,
          .newest = accepted.ahead > 0,
          .behind = receiver_.highest() - accepted.frame.counter,
          .sent_at = std::min(began, first_byte) - peer_.sent.one_way(),
          .began = began,
          .now = now,
          .echoed = accepted.frame.echo ? peer_.sent.HandedOver(*accepted.frame.echo) : std::nullopt};
}

void LinkEndpoint::OnEntry(BundleEntry entry, const Arrival& arrival, std::vector<Delivery>& out) {
  std::visit(Overloaded{[&](StateEntry& e) { inbox_.OnState(std::move(e), arrival, out); },
                        [&](CommandEntry& e) { inbox_.OnCommand(std::move(e), arrival, out); },
                        [&](EventEntry& e) {
                          // The sender repeats it: a number of long ago may name another segment.
                          if (arrival.behind > kFramesApart) return;
                          if (inbox_.OnEvent(e, arrival, out)) events_changed_ = true;
                        },
                        [&](EventAckEntry& e) {
                          if (arrival.behind > kFramesApart) return;
                          if (outbox_.OnEventAck(e, arrival.now) > 0) events_changed_ = true;
                        },
                        [&](FrameAckEntry& e) { OnFrameAck(e, arrival.began); },
                        [&](FloorEntry& e) {
                          memory_.SkipCounters(e.counter);
                          peer_.sent.OnFloor();
                        },
                        [&](ListenEntry& e) {
                          peer_.listeners.OnListen(e, arrival.now);
                          SetWanted(e.channels);
                        },
                        [&](OverEntry&) {
                          if (arrival.newest) scheduler_.OnOver(arrival.now);
                        },
                        [&](ForgetEntry&) { outbox_.ForgetBaselines(); },
                        [&](NextKeyEntry& e) { peer_.OnNextKey(e, arrival.now); }},
             entry);
}

void LinkEndpoint::OnFrameAck(const FrameAckEntry& ack, Time began) {
  for (const std::uint64_t counter : peer_.sent.OnAck(ack, began)) outbox_.OnFrameAcknowledged(counter);
}

void LinkEndpoint::SetWanted(std::uint64_t channels) {
  for (std::size_t i = 0; i < table_->size(); ++i)
    if (table_->at(i).on_request && table_->at(i).direction == outgoing_)
      outbox_.queue().SetWanted(i, (channels >> i & 1U) != 0);
}

void LinkEndpoint::ChangeEpoch(const EpochAgreement::Pair& pair, std::uint32_t peer_stream) {
  const bool onboard = outgoing_ == Direction::kUp;
  const std::uint64_t epoch = keys_.EpochOf(onboard ? pair.own : pair.peer, onboard ? pair.peer : pair.own);
  if (memory_.ChangeEpoch(epoch, peer_stream)) inbox_.ForgetEvents();
  receiver_.SetEpoch(epoch, 0);
  outbox_.OnEpochChanged();
  inbox_.OnEpochChanged();
  peer_.OnEpochChanged();
}

LinkStatus LinkEndpoint::Status(Time now) const {
  const ReceptionCounters& received = receiver_.counters();
  const SendCounters& sent = scheduler_.counters();
  const Handshake* const next = peer_.next_key ? &peer_.next_key->handshake : nullptr;
  // The other end may have changed its key before this one lost its table.
  const bool other_table = next != nullptr && receiver_.Down(now) && next->table_mismatch();
  return {
      .up = !receiver_.Down(now),
      .agreed = memory_.epoch() != 0,
      .alarm = receiver_.alarm(now),
      .table_mismatch = peer_.handshake.table_mismatch() || other_table,
      .key_change = key_change(),
      .peer_code_bytes = (other_table ? *next : peer_.handshake).peer_code_bytes(),
      .round_trip = outbox_.round_trip(),
      .latency = peer_.sent.one_way(),
      .loss = receiver_.loss().loss(),
      .peer_loss = peer_.sent.peer_loss(),
      .bit_error_rate = receiver_.loss().BitErrorRate(),
      .resent = outbox_.resent(),
      .counters = {.bytes_sent = scheduler_.bytes_sent(),
                   .bytes_received = received.bytes,
                   .bundle_bytes_sent = sent.bundle_bytes,
                   .frames_sent = sent.frames,
                   .frames_aborted = sent.aborted,
                   .frames_received = received.frames,
                   .frames_missed = received.missed,
                   .hellos_sent = peer_.handshake.sent() + (next != nullptr ? next->sent() : 0),
                   .hellos_received = peer_.handshake.received() + (next != nullptr ? next->received() : 0),
                   .bundles_damaged = bundles_damaged_,
                   .rejected = received.rejected}};
}

}  // namespace priamos::bus::radio
