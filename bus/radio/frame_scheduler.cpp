#include "bus/radio/frame_scheduler.hpp"

#include <algorithm>
#include <utility>

#include "bus/radio/channels/entry_sizes.hpp"

namespace priamos::bus::radio {
namespace {

/// Beside the round trip: time for the frames of an urgent event and of its acknowledgement.
constexpr Duration kAnswered{30'000};

/// From so many polls without an answer on, every second one is a hello.
constexpr int kUnansweredPolls = 2;

/// The handshake that a hello belongs to; that under the next key may have become the only one meanwhile.
Handshake& HandshakeOf(const FrameInFlight& flight, const FrameSources& from) {
  return flight.next_key && from.peer.next_key ? from.peer.next_key->handshake : from.peer.handshake;
}

/// Bytes of the longest frame where none has a longer bundle, with the delimiter that leads after silence.
std::size_t LongestFrameBytes(const FrameSealer& sealer, const FrameLength& length) {
  return 1 + std::max(kHelloFrameBytes + 1, sealer.overhead() + kWholeCounterBytes + length.bundle_bytes);
}

/// The turns of an end whose frames have at most `longest` bytes.
HalfDuplex TurnsOf(const LinkOptions& options, bool onboard, std::size_t longest) {
  HalfDuplex turns = options.Turns(onboard);
  turns.answer = Pacer(options.bytes_per_s, 0, Time{}).WireTime(longest);
  return turns;
}

}  // namespace

FrameScheduler::FrameScheduler(const ChannelTable& table, const FrameSealer& sealer,
                               const LinkOptions& options, bool onboard, Time now)
    : table_(&table),
      sealer_(sealer),
      options_(options),
      length_(FrameLengthOf(table, options, onboard ? Direction::kUp : Direction::kDown)),
      message_bits_(LargestEntryBits(table, onboard ? Direction::kUp : Direction::kDown)),
      age_bound_(table, onboard ? Direction::kUp : Direction::kDown),
      transmitter_(options, now),
      turns_(TurnsOf(options, onboard, LongestFrameBytes(sealer, length_)), onboard, now),
      repetition_(now),
      last_data_(now - options.keep_alive) {}

std::vector<std::byte> FrameScheduler::Step(FrameSources from, Time now) {
  std::vector<std::byte> out;
  turns_.Step(now, from.peer.sent.one_way());
  if (flight_ && turns_.SlotEndsBefore(transmitter_.RestLeavesAt(now))) GiveUp(from);
  ChooseForm(from, now);
  if (MustCut(from, now)) Cut(from, now, out);
  while (MaySend(from, now)) {
    if (!flight_ && (!turns_.MayTalk(now) || !Build(from, now))) break;
    transmitter_.Emit(now, out);
    if (transmitter_.ContentHandedOver() && flight_->counter != 0)
      from.peer.sent.OnHandedOver(flight_->counter, now);
    if (transmitter_.busy()) continue;
    Finish(from);
    ChooseForm(from, now);
  }
  return out;
}

/// The short form, unless the other end could not complete the counter or the echo. Only short frames carry
/// commands.
void FrameScheduler::ChooseForm(const FrameSources& from, Time now) {
  form_ = from.peer.sent.FormOf(from.memory.last_counter() + 1);
  if (sealer_.echo_bytes() > 0) {
    const auto& newest = from.receiver.newest();
    const bool completes = newest && now - newest->at + from.peer.sent.last_round_trip() <=
                                         EchoReach(options_, sealer_.echo_bytes(), sealer_.code_bytes());
    if (!completes) form_ = CounterForm::kWhole;
  }
  from.outbox.queue().HoldCommands(form_ == CounterForm::kWhole);
}

bool FrameScheduler::MustCut(const FrameSources& from, Time now) const {
  // On a shared channel the bound of every other robot counts on the length of the frame.
  if (turns_.shared() || !flight_ || flight_->urgent || !transmitter_.WorthCutting()) return false;
  if (from.memory.epoch() == 0) return false;
  return from.outbox.queue().UrgentReady(now);
}

bool FrameScheduler::MaySend(const FrameSources& from, Time now) const {
  if (transmitter_.Allows(now)) return true;
  // A datagram cannot be cut off by an urgent one, which therefore does not wait for what is charged to it.
  return options_.instant() && from.memory.epoch() != 0 && from.outbox.queue().UrgentReady(now);
}

bool FrameScheduler::Build(FrameSources from, Time now) {
  const bool agreed = from.memory.epoch() != 0;
  repetition_.NoteUnanswered(from.outbox.queue().UrgentUnanswered(), now);
  repetition_.Step(agreed && from.outbox.queue().RepetitionReady(now), now);
  if (last_ == FrameKind::kUrgent && BuildHandshake(from, now)) return true;
  if (agreed && transmitter_.MayBegin(now, true) && BuildUrgent(from, now)) return true;
  if (!transmitter_.MayBegin(now, false)) return false;
  if (turns_.shared() && !turns_.MayPass(now)) return false;  // granted for urgent messages alone
  repetition_.OnOthersTurn(now);
  return BuildOther(from, now);
}

/// Where ends take turns, a turn may be one frame, and repetitions of an urgent event would take all: what
/// the other end needs to understand them goes in between.
bool FrameScheduler::BuildHandshake(FrameSources from, Time now) {
  if (!turns_.enabled() || turns_.shared() || !transmitter_.MayBegin(now, false)) return false;
  if (BuildAnyHello(from, now)) return true;
  return from.memory.epoch() != 0 && from.peer.handshake.floor_due() && BuildData(from, false, now);
}

/// What is new, then what is repeated. An acknowledgement does not cut a frame off: the other end repeats
/// meanwhile, which costs less than the frame.
bool FrameScheduler::BuildUrgent(FrameSources from, Time now) {
  const bool is_new = from.outbox.queue().UrgentReady(now) || from.inbox.UrgentNews();
  return (is_new || repetition_.GoesFirst(now) || AckAgain(from, now)) && BuildData(from, true, now);
}

/// Whether an acknowledgement of urgent events was lost: they still come when it should long have arrived.
bool FrameScheduler::AckAgain(const FrameSources& from, Time now) const {
  return from.inbox.UrgentAckDue() && now - acknowledged_at_ >= from.peer.sent.last_round_trip() + kAnswered;
}

/// The first frame of an urgent event is short, which is best on a line that carries it. What follows can
/// come through where hardly any frame does: repetitions, acknowledgements of such, and what is new while the
/// line has not answered for longer than it should take.
LineCode FrameScheduler::LineCodeOf(const FrameSources& from, Time now) const {
  if (options_.datagrams || turns_.shared()) return LineCode::kCobs;
  const bool unanswered = repetition_.UnansweredFor(from.peer.sent.last_round_trip() + kAnswered, now);
  if (from.outbox.queue().UrgentReady(now)) return unanswered ? LineCode::kBlock : LineCode::kCobs;
  const auto& newest = from.receiver.newest();
  const bool first_answer = from.inbox.UrgentNews() && newest && newest->line_code == LineCode::kCobs;
  return first_answer ? LineCode::kCobs : LineCode::kBlock;
}

bool FrameScheduler::BuildOther(FrameSources from, Time now) {
  const bool agreed = from.memory.epoch() != 0;
  // Of turns of one frame, or frames that a duty cycle keeps apart, hellos would take all.
  const bool one_at_a_time = turns_.shared() || options_.duty.limited();
  const bool turn_of_data = agreed && one_at_a_time && last_ == FrameKind::kHello;
  // A robot that has started again may not be able to open data, and says nothing before it is asked.
  if (agreed && !turn_of_data && turns_.unanswered() >= kUnansweredPolls) {
    BuildHello(from, from.peer.handshake, sealer_, from.receiver.reception(now), now);
    return true;
  }
  if (!turn_of_data && BuildAnyHello(from, now)) return true;
  return agreed && (DataDue(from, now) || turns_.MayPass(now)) && BuildData(from, false, now);
}

bool FrameScheduler::DataDue(const FrameSources& from, Time now) const {
  return now - last_data_ >= options_.keep_alive || from.peer.Due() || from.peer.handshake.floor_waits() ||
         from.inbox.Due() || !from.outbox.queue().Ready(now).empty();
}

/// Under both keys in turn: where urgent events leave few turns, the one would keep the other back for ever.
bool FrameScheduler::BuildAnyHello(FrameSources from, Time now) {
  const Reception reception = from.receiver.reception(now);
  Handshake& own = from.peer.handshake;
  const bool due = own.HelloDue(reception, now);
  if (from.peer.next_key) {
    NextKey& next = *from.peer.next_key;
    const Reception under_next = next.ReceptionOf(reception, now);
    if (next.handshake.HelloDue(under_next, now) && (!due || next.handshake.last() < own.last())) {
      BuildHello(from, next.handshake, next.sealer(), under_next, now);
      return true;
    }
  }
  if (due) BuildHello(from, own, sealer_, reception, now);
  return due;
}

void FrameScheduler::BuildHello(FrameSources from, Handshake& handshake, const FrameSealer& sealer,
                                Reception reception, Time now) {
  Hello hello = handshake.Take(from.memory.stream(), reception, now);
  hello.over = EndsTurn(from, now);
  flight_.emplace();
  last_ = FrameKind::kHello;
  flight_->over = hello.over;
  // Where no frame arrives, every second one may.
  const bool block = !options_.datagrams && !turns_.shared() && handshake.sent() % 2 == 1;
  flight_->next_key = &sealer != &sealer_;
  transmitter_.Begin(sealer.Seal(hello, block ? LineCode::kBlock : LineCode::kCobs), now);
}

bool FrameScheduler::BuildData(FrameSources from, bool urgent_only, Time now) {
  const LineCode line_code = urgent_only ? LineCodeOf(from, now) : LineCode::kCobs;
  BundleBuilder builder = NewBundle(from, urgent_only, line_code, now);
  FrameInFlight flight = Fill(builder, from, urgent_only, line_code, now);
  // Nothing that is ready could be packed: no frame for nothing.
  if (builder.empty() && now - last_data_ < options_.keep_alive) return false;
  const std::vector<std::byte> bundle = builder.Finish();
  flight.bundle_bytes = bundle.size();
  flight.counter = from.memory.TakeCounter();
  const auto& newest = from.receiver.newest();
  auto wire = sealer_.Seal(from.memory.epoch(), flight.counter, form_, bundle, newest ? newest->counter : 0,
                           line_code);
  last_data_ = now;
  last_ = urgent_only ? FrameKind::kUrgent : FrameKind::kMixed;
  from.peer.sent.OnSent(flight.counter, transmitter_.LeavesAt(wire.size(), now));
  if (urgent_only && !flight.inbox.acks.empty()) acknowledged_at_ = now;
  // Of a shared channel a repetition takes a turn, whatever its length.
  if (flight.repeats)
    repetition_.OnRepeated(now, turns_.shared() ? turns_.period() : transmitter_.Occupies(wire.size()));
  if (age_bound_.enabled()) age_bound_.OnFrame(flight.outbox.Has(age_bound_.channel()), flight.first, now);
  flight_ = std::move(flight);
  transmitter_.Begin(std::move(wire), now);
  return true;
}

/// Whether a hello ends the turn. Its answer is what is needed. On a link that works it answers one that may
/// be a replay: that must not cost the turn, other than one that is no longer than this frame.
bool FrameScheduler::EndsTurn(const FrameSources& from, Time now) const {
  if (turns_.shared()) return turns_.MayPass(now);
  return turns_.enabled() && from.receiver.reception(now) != Reception::kHeard;
}

bool FrameScheduler::EndsTurn(const FrameSources& from, std::size_t frame_bytes, Time now) const {
  if (!turns_.enabled()) return false;
  const Pacer& pacer = transmitter_.pacer();
  const Duration longest = pacer.WireTime(options_.HeadBytes() + length_.bundle_bytes + sealer_.overhead());
  if (turns_.MustEnd(pacer.LeavesAt(options_.HeadBytes() + frame_bytes, now), longest)) return true;
  if (turns_.shared()) return false;
  return !from.inbox.AckDue() && from.outbox.queue().Ready(now).empty();
}

void FrameScheduler::Cut(FrameSources from, Time now, std::vector<std::byte>& out) {
  transmitter_.Cut(now, out);
  TakeBack(from);
}

/// A robot's answer that would go on into the turn of another one.
void FrameScheduler::GiveUp(FrameSources from) {
  transmitter_.Drop();
  turns_.Revoke();
  TakeBack(from);
}

/// Nothing of the frame counts as sent.
void FrameScheduler::TakeBack(FrameSources from) {
  FrameInFlight flight = std::move(*flight_);
  flight_.reset();
  ++counters_.aborted;
  if (flight.counter != 0) age_bound_.Undo();
  from.outbox.Return(std::move(flight.outbox));
  from.inbox.Return(flight.inbox);
  from.peer.Return(flight.peer);
  if (flight.counter == 0) HandshakeOf(flight, from).Return();
}

void FrameScheduler::Finish(FrameSources from) {
  FrameInFlight flight = std::move(*flight_);
  flight_.reset();
  turns_.OnFrameSent();
  if (flight.over) turns_.OnOverSent(transmitter_.pacer().free_at());
  from.outbox.OnSent(std::move(flight.outbox), flight.counter);
  if (flight.counter == 0) return HandshakeOf(flight, from).OnSent();
  ++counters_.frames;
  counters_.bundle_bytes += flight.bundle_bytes;
}

}  // namespace priamos::bus::radio
