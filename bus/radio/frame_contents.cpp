#include <algorithm>
#include <utility>

#include "bus/radio/frame_scheduler.hpp"

// What a frame carries, and how long it may be for that; frame_scheduler.cpp decides which frame goes next.

namespace priamos::bus::radio {
namespace {

/// What a proof takes beside the delays of the line: bytes written ahead, and ticks of both ends.
constexpr Duration kProofMargin{10'000};

/// Acknowledgements and announcements in a frame beside its messages, about as many as there can be.
constexpr std::size_t kControlBytes = 32;

}  // namespace

/// What goes first for the sake of the state whose age is bounded.
std::optional<AgeBound::First> FrameScheduler::ChooseFirst(const BundleBuilder& bundle,
                                                           const FrameSources& from, Time now) const {
  const MessageSender::Beside beside =
      from.outbox.WaitingBeside(age_bound_.channel(), age_bound_.promised(), bundle.target_bytes(), now);
  const auto takes = [&](std::size_t bytes) { return transmitter_.Occupies(FrameBytes(bytes)); };
  // A hello, which the other end may ask for, goes before any data.
  const AgeBound::Waiting waiting{
      .state = from.outbox.queue().Newest(age_bound_.channel()),
      .alone = beside.alone,
      .state_takes = takes(age_bound_.entry_bytes()) + transmitter_.Occupies(1 + kHelloFrameBytes),
      .alone_takes = takes(beside.alone_bytes),
      .others_take = takes(std::min(beside.bytes + kControlBytes, bundle.target_bytes())),
      .longest_takes = takes(bundle.target_bytes())};
  return age_bound_.Choose(waiting, std::max(transmitter_.pacer().free_at(), now));
}

/// Bytes of a frame with the short form of the counter, with the delimiter that leads after silence.
std::size_t FrameScheduler::FrameBytes(std::size_t bundle_bytes) const {
  return 1 + sealer_.overhead() + bundle_bytes;
}

/// Bytes of a bundle whose frame, begun now, has left by then.
std::size_t FrameScheduler::BytesBy(Time end, Time now) const {
  const Pacer& pacer = transmitter_.pacer();
  const std::int64_t bytes = (end - std::max(pacer.free_at(), now)) / pacer.WireTime(1) -
                             static_cast<std::int64_t>(options_.HeadBytes() + sealer_.overhead());
  return static_cast<std::size_t>(std::max<std::int64_t>(bytes, 0));
}

BundleBuilder FrameScheduler::NewBundle(const FrameSources& from, bool urgent_only, LineCode line_code,
                                        Time now) const {
  BundleBuilder bundle(*table_, TargetBytes(from, line_code, now), turns_.enabled(), sealer_.overhead());
  if (length_.strict && (turns_.shared() || !urgent_only)) bundle.Confine(message_bits_);
  return bundle;
}

/// The budget of a radio that takes turns counts with frames of full length; acknowledgements may be rare
/// there.
std::size_t FrameScheduler::TargetBytes(const FrameSources& from, LineCode line_code, Time now) const {
  if (line_code == LineCode::kBlock) return sealer_.MaxBlockBundle(form_);
  const SentFrames& sent = from.peer.sent;
  return BestBundleBytes(length_.bundle_bytes, turns_.enabled() ? sent.peer_loss() : sent.ExpectedLoss(now),
                         FrameOverhead(sealer_.code_bytes()));
}

FrameInFlight FrameScheduler::Fill(BundleBuilder& bundle, FrameSources from, bool urgent_only,
                                   LineCode line_code, Time now) const {
  FrameInFlight flight;
  flight.urgent = urgent_only && from.outbox.queue().UrgentReady(now);
  flight.repeats = urgent_only && !flight.urgent;
  const Departure departure{.now = now,
                            .counter = from.memory.last_counter() + 1,
                            .urgent_only = urgent_only,
                            .leaves_at = [&](std::size_t bytes) { return transmitter_.LeavesAt(bytes, now); },
                            .echoed_at = EchoedAt(from),
                            .bytes_until = [&](Time until) { return BytesUntil(until, from, now); }};
  if (age_bound_.enabled() && !urgent_only) {
    flight.first = ChooseFirst(bundle, from, now);
    if (flight.first)
      flight.outbox =
          from.outbox.LoadFirst(bundle, flight.first->message, BytesBy(flight.first->end, now), departure);
  }
  LoadControl(bundle, from, flight, now);
  flight.outbox = from.outbox.Load(bundle, departure, std::move(flight.outbox));
  flight.over = EndsTurn(from, sealer_.WireBytes(form_, bundle.Bytes(), line_code), now);
  if (flight.over) bundle.AddOver();
  return flight;
}

/// Adds acknowledgements and what else the ends report to each other.
void FrameScheduler::LoadControl(BundleBuilder& bundle, FrameSources from, FrameInFlight& flight,
                                 Time now) const {
  const bool urgent_only = flight.urgent || flight.repeats;
  // In a short frame what waits for an acknowledgement goes before the acknowledgement of frames.
  if (turns_.shared()) flight.inbox = from.inbox.Load(bundle, urgent_only);
  // Without acknowledgements of frames the other end would write the counters of its repetitions in full.
  if (!urgent_only || (flight.repeats && from.inbox.UrgentAckDue())) {
    flight.peer = from.peer.Load(bundle,
                                 {.highest = from.receiver.highest(),
                                  .at = from.receiver.heard_at(),
                                  .loss = from.receiver.loss().loss(),
                                  .floor = from.memory.receive_floor()},
                                 urgent_only, now);
  }
  if (!turns_.shared()) flight.inbox = from.inbox.Load(bundle, urgent_only);
}

std::optional<Time> FrameScheduler::EchoedAt(const FrameSources& from) const {
  const auto& newest = from.receiver.newest();
  if (form_ == CounterForm::kWhole || !newest) return std::nullopt;
  return newest->at;
}

/// A longer frame with a command in it would come too late for it, on a line that is as slow as it was last.
std::size_t FrameScheduler::BytesUntil(Time until, const FrameSources& from, Time now) const {
  if (options_.instant()) return kMaxBundleBytes;  // they go whole
  return BytesBy(until - from.peer.sent.last_round_trip() - kProofMargin, now);
}

}  // namespace priamos::bus::radio
