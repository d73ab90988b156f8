#include <algorithm>
#include <cmath>
#include <utility>

#include "bus/radio/link.hpp"

/// The sending half of LinkEndpoint: what goes into the next frame, and when its bytes may leave.
namespace priamos::bus::radio {
namespace {

constexpr Duration kHelloRepeat{300'000};      // while agreeing
constexpr Duration kHelloAnnounce{1'000'000};  // while the link is down: lets a wrong table be seen
constexpr Duration kFrameAckGap{250'000};
constexpr std::uint64_t kFramesPerAck = 24;  // well below the 64 that the low counter bits bridge
constexpr Duration kListenRepeat{2'000'000};
constexpr std::size_t kRememberedFrames = 64;
constexpr std::uint64_t kLowBitsReach = 64;
/// An abort costs a delimiter; a frame with no more than this to go is faster finished.
constexpr std::size_t kNotWorthAborting = 2;
/// After such a silence a delimiter leads, so that what noise left in the receiver does not spoil the frame.
constexpr std::size_t kIdleBytes = 16;
/// The smallest target when errors are many: one segment of an event and its head.
constexpr std::size_t kSmallestBundle = 60;

}  // namespace

std::vector<std::byte> LinkEndpoint::Step(Time now) {
  std::vector<std::byte> out;
  queue_.Expire(now);
  if (wanted_until_ && now >= *wanted_until_) {
    wanted_until_.reset();
    SetWanted(0);
  }
  turns_.Step(now, latency_.one_way());
  if (flight_ && !flight_->urgent && flight_->wire.size() - flight_->next > kNotWorthAborting &&
      memory_.epoch() != 0 && queue_.UrgentReady(now, flight_->repeats))
    Abort(now, out);
  while (MaySend(now)) {
    if (!flight_ && (!turns_.MayTalk(now) || !BuildFrame(now))) break;
    do {
      Emit(flight_->wire[flight_->next++], now, out);
    } while (options_.datagrams && flight_->next < flight_->wire.size());
    if (flight_->next == flight_->wire.size()) Finish();
  }
  return out;
}

bool LinkEndpoint::MaySend(Time now) const {
  // A datagram cannot be cut off by an urgent one, which therefore does not wait for what is charged to it.
  return pacer_.Allows(now) || (options_.datagrams && memory_.epoch() != 0 && queue_.UrgentReady(now));
}

Duration LinkEndpoint::OnTheWay(std::size_t bytes) const {
  return options_.datagrams ? Duration::zero() : pacer_.WireTime(bytes);
}

Time LinkEndpoint::LeavesAt(std::size_t bytes, Time now) const {
  return options_.datagrams ? now : pacer_.LeavesAt(bytes, now);
}

void LinkEndpoint::Emit(std::byte byte, Time now, std::vector<std::byte>& out) {
  out.push_back(byte);
  pacer_.Use(now);
  ++counters_.bytes_sent;
}

bool LinkEndpoint::BuildFrame(Time now) {
  const bool agreed = memory_.epoch() != 0;
  if (agreed && queue_.UrgentReady(now)) BuildData(now, true);
  if (!flight_ && HelloDue(now)) BuildHello(now);
  if (!flight_ && agreed && (DataDue(now) || turns_.MayPass(now))) BuildData(now, false);
  return flight_.has_value();
}

bool LinkEndpoint::HelloDue(Time now) const {
  if (!hello_limit_.Allows(now)) return false;
  if (hello_reply_) return true;
  const Duration since = now - last_hello_;
  if (Needy(now) || switched_) return since >= kHelloRepeat;
  return Down(now) && since >= kHelloAnnounce;
}

void LinkEndpoint::BuildHello(Time now) {
  Hello hello = agreement_.Compose(Needy(now));
  hello.table_hash = table_.hash();
  hello.stream = memory_.stream();
  hello_reply_ = false;
  last_hello_ = now;
  hello_limit_.Use(now);
  Flight flight;
  flight.over = hello.over = turns_.enabled();  // the answer is what is needed
  Launch(std::move(flight), sealer_.Seal(hello), now);
}

bool LinkEndpoint::FrameAckDue(Time now) const {
  return frames_since_ack_ > 0 &&
         (frames_since_ack_ >= kFramesPerAck || !last_frame_ack_ || now - *last_frame_ack_ >= kFrameAckGap);
}

bool LinkEndpoint::DataDue(Time now) const {
  if (now - last_data_ >= options_.keep_alive || frames_since_ack_ >= kFramesPerAck || listen_due_ ||
      forget_due_)
    return true;
  return AckDue() || !queue_.Ready(now).empty();
}

bool LinkEndpoint::AckDue() const {
  return std::any_of(receivers_.begin(), receivers_.end(),
                     [](const EventReceiver& r) { return r.ack_due(); });
}

void LinkEndpoint::BuildData(Time now, bool urgent_only) {
  Flight flight;
  flight.urgent = urgent_only && queue_.UrgentReady(now, true);
  flight.repeats = urgent_only && !flight.urgent;
  BitWriter bundle;
  if (!urgent_only) AddControl(now, bundle, flight);
  AddMessages(now, urgent_only, bundle, flight);
  AddOver(now, bundle, flight);
  // Nothing that is ready could be packed: no frame for nothing.
  if (bundle.bits() == 0 && now - last_data_ < options_.keep_alive) return;
  flight.counter = memory_.TakeCounter();
  flight.bundle_bytes = bundle.bytes().size();
  auto wire = sealer_.Seal(memory_.epoch(), flight.counter, FormOf(flight.counter), bundle.bytes());
  last_data_ = now;
  sent_frames_.push_back({flight.counter, LeavesAt(wire.size(), now)});
  if (sent_frames_.size() > kRememberedFrames) sent_frames_.pop_front();
  Launch(std::move(flight), std::move(wire), now);
}

void LinkEndpoint::AddOver(Time now, BitWriter& bundle, Flight& flight) const {
  if (!turns_.enabled()) return;
  const Time end = pacer_.LeavesAt(bundle.bytes().size() + kFrameOverhead, now);
  const Duration longest = pacer_.WireTime(options_.max_bundle_bytes + kFrameOverhead);
  if (!turns_.MustEnd(end, longest) && (AckDue() || !queue_.Ready(now).empty())) return;
  WriteEntry(table_, OverEntry{}, bundle);
  flight.over = true;
}

void LinkEndpoint::Launch(Flight flight, std::vector<std::byte> wire, Time now) {
  flight.wire = std::move(wire);
  for (std::size_t i = 0; options_.datagrams && i < kDatagramHead; ++i) pacer_.Use(now);
  if (!options_.datagrams && pacer_.Idle(now) >= pacer_.WireTime(kIdleBytes))
    flight.wire.insert(flight.wire.begin(), kDelimiter);
  flight_ = std::move(flight);
}

CounterForm LinkEndpoint::FormOf(std::uint64_t counter) const {
  return confirmed_ && counter <= *confirmed_ + kLowBitsReach ? CounterForm::kLowBits : CounterForm::kWhole;
}

std::size_t LinkEndpoint::BundleTarget() const {
  if (peer_loss_ <= 0) return options_.max_bundle_bytes;
  // Goodput (1 - h / n) (1 - p)^(10 n) of n bytes with h of overhead is largest near n = sqrt(h / (10 p)).
  const double mean = static_cast<double>(options_.max_bundle_bytes) / 2;
  const double p = -std::log(1 - std::min(peer_loss_, 0.95)) / (10 * mean);
  const double best = std::sqrt(static_cast<double>(kFrameOverhead) / (10 * p));
  return std::min(options_.max_bundle_bytes, std::max(kSmallestBundle, static_cast<std::size_t>(best)));
}

bool LinkEndpoint::AddEntry(const BundleEntry& entry, BitWriter& bundle, const Flight& flight) const {
  const std::size_t bits = bundle.bits() + EntryBits(table_, entry);
  const bool alone = flight.messages.empty() && flight.segments.empty();
  const std::size_t reserved = turns_.enabled() ? EntryBits(table_, OverEntry{}) : 0;
  if (bits + reserved > 8 * (alone ? kMaxBundleBytes : BundleTarget())) return false;
  WriteEntry(table_, entry, bundle);
  return true;
}

void LinkEndpoint::AddControl(Time now, BitWriter& bundle, Flight& flight) {
  if (FrameAckDue(now)) {
    AddEntry(FrameAckEntry{.counter = static_cast<std::uint16_t>(opener_.highest() & 0xFFF),
                           .earlier = static_cast<std::uint8_t>(in_turn_ >> 1 & ((1U << kEarlierFrames) - 1)),
                           .hold = now - *last_valid_,
                           .loss = loss_.loss()},
             bundle, flight);
    frames_since_ack_ = 0;
    last_frame_ack_ = now;
    flight.frame_ack = true;
  }
  if (floor_due_) AddEntry(FloorEntry{memory_.receive_floor()}, bundle, flight);
  if (listen_due_ || (listening_ != 0 && now - last_listen_.value_or(Time{}) >= kListenRepeat)) {
    AddEntry(ListenEntry{listening_}, bundle, flight);
    listen_due_ = false;
    last_listen_ = now;
    flight.listen = true;
  }
  if (forget_due_) {
    AddEntry(ForgetEntry{}, bundle, flight);
    forget_due_ = false;
    flight.forget = true;
  }
  for (std::size_t i = 0; i < receivers_.size(); ++i) {
    if (!receivers_[i].ack_due()) continue;
    if (!AddEntry(EventAckEntry{i, receivers_[i].ack()}, bundle, flight)) break;
    receivers_[i].set_ack_due(false);
    flight.acks.push_back(i);
  }
}

void LinkEndpoint::AddMessages(Time now, bool urgent_only, BitWriter& bundle, Flight& flight) {
  for (const SendQueue::Candidate& candidate : queue_.Ready(now)) {
    if (urgent_only && !candidate.urgent) return;
    if (table_.at(candidate.channel).channel_class == ChannelClass::kEvent) {
      AddSegments(candidate.channel, now, urgent_only, bundle, flight);
    } else {
      AddNewest(candidate, now, bundle, flight);
    }
  }
}

void LinkEndpoint::AddSegments(std::size_t channel, Time now, bool urgent_only, BitWriter& bundle,
                               Flight& flight) {
  // What is urgent now is not made longer by repetitions of what was urgent before.
  const bool fresh_only = urgent_only && queue_.NextIsFresh(channel, now);
  while (!fresh_only || queue_.NextIsFresh(channel, now))
    if (!AddSegment(channel, now, bundle, flight)) return;
}

bool LinkEndpoint::AddSegment(std::size_t channel, Time now, BitWriter& bundle, Flight& flight) {
  const auto segment = queue_.PeekEvent(channel, now);
  if (!segment || !AddEntry(EventEntry{channel, *segment}, bundle, flight)) return false;
  const std::size_t wire_bytes = bundle.bytes().size() + kFrameOverhead;
  queue_.TakeEvent(channel, segment->number, now, LeavesAt(wire_bytes, now));
  queue_.counters(channel).bits += segment->bits;
  flight.segments.push_back({channel, segment->number});
  return true;
}

void LinkEndpoint::AddNewest(const SendQueue::Candidate& candidate, Time now, BitWriter& bundle,
                             Flight& flight) {
  const std::size_t channel = candidate.channel;
  auto packed = pack_(channel, queue_.Peek(candidate), now);
  if (!packed) {
    queue_.Take(candidate);
    queue_.CountRefused(channel);
    return;
  }
  const BundleEntry entry = NewestEntry(candidate, *packed, now);
  if (!AddEntry(entry, bundle, flight)) return;
  if (packed->saturated) ++queue_.counters(channel).saturated;
  const auto* state = std::get_if<StateEntry>(&entry);
  if (table_.at(channel).delta.empty()) packed->bytes.clear();
  std::size_t bits = packed->bits;
  if (state != nullptr && state->baseline) bits = state->bits + kBaselineBits;
  flight.messages.push_back({queue_.Take(candidate), bits, std::move(packed->bytes)});
}

BundleEntry LinkEndpoint::NewestEntry(const SendQueue::Candidate& candidate, const Packed& packed,
                                      Time now) const {
  const LinkChannel& channel = table_.at(candidate.channel);
  if (channel.channel_class == ChannelClass::kCommand)
    return CommandEntry{candidate.channel, now - queue_.OfferedAt(candidate), packed.bits, packed.bytes};
  StateEntry entry{candidate.channel, packed.bits, packed.bytes};
  if (channel.delta.empty()) return entry;
  const auto* baseline = delta_senders_[candidate.channel].Baseline(memory_.last_counter() + 1);
  if (baseline == nullptr) return entry;
  const BitWriter delta = EncodeDelta(channel.delta, baseline->packed, packed.bytes);
  if (delta.bits() + kBaselineBits >= packed.bits) return entry;
  return StateEntry{candidate.channel, delta.bits(), delta.bytes(),
                    static_cast<std::uint8_t>(baseline->counter & kDeltaReach)};
}

void LinkEndpoint::Abort(Time now, std::vector<std::byte>& out) {
  Flight flight = std::move(*flight_);
  flight_.reset();
  // Cut off by a delimiter it is no frame; if nothing of it has left, it never was.
  if (flight.next > 0) Emit(kDelimiter, now, out);
  ++counters_.frames_aborted;
  for (SentMessage& m : flight.messages) queue_.Return(std::move(m.message));
  for (const SentSegment& s : flight.segments) queue_.events(s.channel).MarkUnsent(s.number);
  for (const std::size_t channel : flight.acks) receivers_[channel].set_ack_due(true);
  if (flight.frame_ack) frames_since_ack_ += 1;
  if (flight.frame_ack) last_frame_ack_.reset();
  if (flight.listen) listen_due_ = true;
  if (flight.forget) forget_due_ = true;
  if (flight.counter == 0) hello_reply_ = true;
}

void LinkEndpoint::Finish() {
  if (flight_->over) turns_.OnOverSent(pacer_.free_at());
  for (SentMessage& m : flight_->messages) {
    queue_.CountSent(m.message.channel, m.bits);
    if (!m.packed.empty()) delta_senders_[m.message.channel].OnSent(flight_->counter, std::move(m.packed));
  }
  if (flight_->counter == 0) {
    ++counters_.hellos_sent;
  } else {
    ++counters_.frames_sent;
    counters_.bundle_bytes_sent += flight_->bundle_bytes;
  }
  flight_.reset();
}

}  // namespace priamos::bus::radio
