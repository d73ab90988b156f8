#include "bus/radio/message_sender.hpp"

#include <algorithm>
#include <utility>

#include "bus/radio/channels/entry_sizes.hpp"

namespace priamos::bus::radio {

MessageSender::MessageSender(const ChannelTable& table, Direction outgoing, Duration ageing,
                             PackFunction pack)
    : table_(&table),
      outgoing_(outgoing),
      pack_(std::move(pack)),
      queue_(table, outgoing, ageing),
      deltas_(table.size()) {}

OfferResult MessageSender::Offer(std::size_t channel, std::span<const std::byte> encoded, Time now,
                                 std::string_view key, std::optional<Time> made) {
  if (channel >= table_->size() || table_->at(channel).direction != outgoing_)
    return OfferResult::kNotOutgoing;
  if (table_->at(channel).channel_class != ChannelClass::kEvent)
    return queue_.Offer(channel, key, encoded, now, made) ? OfferResult::kAccepted : OfferResult::kRefused;
  auto packed = pack_(channel, encoded, now);
  if (!packed) {
    queue_.CountRefused(channel);
    return OfferResult::kRefused;
  }
  if (packed->saturated) ++queue_.counters(channel).saturated;
  return queue_.OfferEvent(channel, std::move(packed->bytes), packed->bits, now) ? OfferResult::kAccepted
                                                                                 : OfferResult::kRefused;
}

bool MessageSender::Loaded::Has(std::size_t channel) const {
  return std::any_of(messages.begin(), messages.end(),
                     [&](const Message& m) { return m.queued.channel == channel; });
}

MessageSender::Beside MessageSender::WaitingBeside(std::size_t channel,
                                                   const std::optional<SendQueue::Candidate>& promised,
                                                   std::size_t target_bytes, Time now) const {
  const auto bytes = [](std::size_t bits) { return (bits + 7) / 8; };
  Beside beside;
  std::size_t bits = 0;
  for (const SendQueue::Candidate& candidate : queue_.Ready(now)) {
    if (candidate.channel == channel || queue_.IsRepetition(candidate.channel, now)) continue;
    const std::size_t own_bits = BitsOf(candidate, now);
    const bool is_promised =
        promised && promised->channel == candidate.channel && promised->slot == candidate.slot;
    const bool goes_alone =
        table_->at(candidate.channel).channel_class != ChannelClass::kEvent && own_bits > 8 * target_bytes;
    if (is_promised || (goes_alone && bits == 0 && !beside.alone)) beside.alone = candidate;
    if (!goes_alone) bits += own_bits;
  }
  if (beside.alone)
    beside.alone_bytes = bytes(static_cast<std::size_t>(SizesOf(*table_, beside.alone->channel).entry_bits));
  beside.bytes = std::min(bytes(bits), target_bytes);
  return beside;
}

/// Bits of the entry of a message; of those of all events that wait.
std::size_t MessageSender::BitsOf(const SendQueue::Candidate& candidate, Time now) const {
  const EntrySizes sizes = SizesOf(*table_, candidate.channel);
  if (table_->at(candidate.channel).channel_class == ChannelClass::kEvent)
    return static_cast<std::size_t>(sizes.bits) * queue_.events(candidate.channel).events().size();
  const auto packed = pack_(candidate.channel, queue_.Peek(candidate), now);
  if (!packed) return 0;  // it is refused when its turn comes
  return BundleWriter(*table_).BitsWith(StateEntry{candidate.channel, packed->bits, packed->bytes});
}

MessageSender::Loaded MessageSender::LoadFirst(BundleBuilder& bundle, const SendQueue::Candidate& first,
                                               std::size_t most_bytes, const Departure& departure) {
  Loaded loaded;
  LoadNewest(first, bundle, departure, loaded);
  bundle.LimitTo(std::max(most_bytes, bundle.Bytes()));
  return loaded;
}

MessageSender::Loaded MessageSender::Load(BundleBuilder& bundle, const Departure& departure, Loaded loaded) {
  for (const SendQueue::Candidate& candidate : queue_.Ready(departure.now)) {
    if (departure.urgent_only && !candidate.urgent) break;
    // Repetitions have frames of their own, as short as can be.
    if (!departure.urgent_only && queue_.IsRepetition(candidate.channel, departure.now)) continue;
    if (!MayLoad(candidate, departure)) continue;
    if (table_->at(candidate.channel).channel_class == ChannelClass::kEvent) {
      LoadSegments(candidate.channel, bundle, departure, loaded);
    } else {
      LoadNewest(candidate, bundle, departure, loaded);
    }
  }
  return loaded;
}

/// A command needs an echo to count from, and must not be older than the smallest offset can say.
bool MessageSender::MayLoad(const SendQueue::Candidate& candidate, const Departure& departure) const {
  const LinkChannel& channel = table_->at(candidate.channel);
  return channel.channel_class != ChannelClass::kCommand ||
         (departure.echoed_at && departure.now - queue_.MadeAt(candidate) <= channel.ttl);
}

void MessageSender::LoadSegments(std::size_t channel, BundleBuilder& bundle, const Departure& departure,
                                 Loaded& loaded) {
  // What is urgent now is not made longer by repetitions of what was urgent before, and of these one goes at
  // a time: of a short frame more come through.
  const bool fresh_only = departure.urgent_only && queue_.NextIsFresh(channel, departure.now);
  const bool one_only = departure.urgent_only && !fresh_only;
  while (!fresh_only || queue_.NextIsFresh(channel, departure.now))
    if (!LoadSegment(channel, bundle, departure, loaded) || one_only) return;
}

bool MessageSender::LoadSegment(std::size_t channel, BundleBuilder& bundle, const Departure& departure,
                                Loaded& loaded) {
  const auto segment = queue_.PeekEvent(channel, departure.now);
  if (!segment || !bundle.Add(EventEntry{channel, *segment})) return false;
  queue_.TakeEvent(channel, segment->number, departure.now, departure.leaves_at(bundle.FrameBytes()));
  queue_.counters(channel).bits += segment->bits;
  loaded.segments.push_back({channel, segment->number});
  return true;
}

void MessageSender::LoadNewest(const SendQueue::Candidate& candidate, BundleBuilder& bundle,
                               const Departure& departure, Loaded& loaded) {
  const std::size_t channel = candidate.channel;
  const bool command = table_->at(channel).channel_class == ChannelClass::kCommand;
  auto packed = pack_(channel, queue_.Peek(candidate), command ? queue_.MadeAt(candidate) : departure.now);
  if (!packed) {
    queue_.Take(candidate);
    queue_.CountRefused(channel);
    return;
  }
  const BundleEntry entry = EntryOf(candidate, *packed, departure);
  if (!bundle.Add(entry)) return;
  if (command && departure.bytes_until) {
    const Duration largest_offset = table_->at(channel).ttl * (kOffsetSteps - 1) / kOffsetSteps;
    bundle.LimitTo(departure.bytes_until(queue_.MadeAt(candidate) + largest_offset));
  }
  if (packed->saturated) ++queue_.counters(channel).saturated;
  const auto* state = std::get_if<StateEntry>(&entry);
  if (table_->at(channel).delta.empty()) packed->bytes.clear();
  std::size_t bits = packed->bits;
  if (state != nullptr && state->baseline) bits = state->bits + kBaselineBits;
  loaded.messages.push_back({queue_.Take(candidate), bits, std::move(packed->bytes)});
}

BundleEntry MessageSender::EntryOf(const SendQueue::Candidate& candidate, const Packed& packed,
                                   const Departure& departure) const {
  const LinkChannel& channel = table_->at(candidate.channel);
  if (channel.channel_class == ChannelClass::kCommand)
    return CommandEntry{candidate.channel, queue_.MadeAt(candidate) - *departure.echoed_at, packed.bits,
                        packed.bytes};
  StateEntry entry{candidate.channel, packed.bits, packed.bytes};
  if (channel.delta.empty()) return entry;
  const auto* baseline = deltas_[candidate.channel].Baseline(departure.counter);
  if (baseline == nullptr) return entry;
  BitWriter delta = EncodeDelta(channel.delta, baseline->packed, packed.bytes);
  const std::size_t bits = delta.bits();
  if (bits + kBaselineBits >= packed.bits) return entry;
  return StateEntry{candidate.channel, bits, delta.Finish(),
                    static_cast<std::uint8_t>(baseline->counter & kDeltaReach)};
}

void MessageSender::Return(Loaded loaded) {
  for (Loaded::Message& m : loaded.messages) queue_.Return(std::move(m.queued));
  for (const Loaded::Segment& s : loaded.segments) queue_.events(s.channel).MarkUnsent(s.number);
}

void MessageSender::OnSent(Loaded loaded, std::uint64_t counter) {
  for (Loaded::Message& m : loaded.messages) {
    queue_.CountSent(m.queued.channel, m.bits);
    if (!m.packed.empty()) deltas_[m.queued.channel].OnSent(counter, std::move(m.packed));
  }
}

std::size_t MessageSender::OnEventAck(const EventAckEntry& entry, Time now) {
  const std::size_t done = queue_.events(entry.channel).OnAck(entry.ack, now, round_trip_);
  for (std::size_t i = 0; i < table_->size(); ++i) queue_.events(i).set_timeout(round_trip_.timeout());
  queue_.counters(entry.channel).sent += done;
  return done;
}

void MessageSender::OnFrameAcknowledged(std::uint64_t counter) {
  for (DeltaSender& sender : deltas_) sender.OnAcknowledged(counter);
}

void MessageSender::ForgetBaselines() {
  for (DeltaSender& sender : deltas_) sender.Forget();
}

void MessageSender::OnEpochChanged() {
  ResendEvents(true);
  ForgetBaselines();
}

void MessageSender::ResendEvents(bool forgotten) {
  for (std::size_t i = 0; i < table_->size(); ++i) queue_.events(i).ResendAll(forgotten);
}

std::uint64_t MessageSender::resent() const {
  std::uint64_t resent = 0;
  for (std::size_t i = 0; i < table_->size(); ++i) resent += queue_.events(i).resent();
  return resent;
}

}  // namespace priamos::bus::radio
