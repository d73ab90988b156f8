#include "bus/radio/channels/event_stream.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr Duration kFirstTimeout{600'000};
constexpr Duration kMinTimeout{100'000};
constexpr Duration kMaxTimeout{3'000'000};

std::size_t SegmentsOf(std::size_t bytes) {
  return std::max<std::size_t>(1, (bytes + kSegmentBytes - 1) / kSegmentBytes);
}

}  // namespace

void RoundTrip::Sample(Duration round_trip) {
  if (smoothed_ < Duration::zero()) {
    smoothed_ = round_trip;
    deviation_ = round_trip / 2;
    return;
  }
  const Duration error = round_trip - smoothed_;
  smoothed_ += error / 8;
  deviation_ += (std::chrono::abs(error) - deviation_) / 4;
}

Duration RoundTrip::timeout() const {
  if (smoothed_ < Duration::zero()) return kFirstTimeout;
  return std::clamp(smoothed_ + 4 * deviation_, kMinTimeout, kMaxTimeout);
}

bool EventSender::Offer(std::vector<std::byte> packed, std::size_t bits, Time now) {
  if (events_.size() >= kCapacity || SegmentsOf(packed.size()) > kEventWindow) return false;
  Restore({.first = next_, .packed_at = now, .bits = bits, .packed = std::move(packed), .released = false});
  return true;
}

void EventSender::Restore(Event event) {
  Cut(event);
  next_ = static_cast<std::uint8_t>(event.first + SegmentsOf(event.packed.size()));
  events_.push_back(std::move(event));
}

void EventSender::Cut(const Event& event) {
  for (std::size_t i = 0; i < SegmentsOf(event.packed.size()); ++i)
    segments_.push_back({.number = static_cast<std::uint8_t>(event.first + i),
                         .event = first_event_ + events_.size(),
                         .offset = i * kSegmentBytes});
}

bool EventSender::Due(const Segment& segment, Time now, bool urgent) const {
  if (segment.held) return false;
  if (!segment.sent) return true;
  return urgent ? now > segment.begun_at : now >= segment.sent_at + timeout_;
}

const EventSender::Segment* EventSender::NextDue(Time now, bool urgent) const {
  const std::size_t n = std::min(segments_.size(), kEventWindow);
  const Segment* overdue = nullptr;
  for (std::size_t i = 0; i < n; ++i) {
    if (!Due(segments_[i], now, urgent)) continue;
    if (!urgent || segments_[i].times == 0) return &segments_[i];
    if (overdue == nullptr || segments_[i].begun_at < overdue->begun_at) overdue = &segments_[i];
  }
  return overdue;
}

bool EventSender::Ready(Time now, bool urgent) const {
  return NextDue(now, urgent) != nullptr;
}

bool EventSender::NextIsFresh(Time now, bool urgent) const {
  const Segment* s = NextDue(now, urgent);
  return s != nullptr && s->times == 0;
}

bool EventSender::NextIsNew(Time now, bool urgent) const {
  const Segment* s = NextDue(now, urgent);
  return s != nullptr && !events_[s->event - first_event_].released;
}

Time EventSender::NextPackedAt(Time now, bool urgent) const {
  const Segment* s = NextDue(now, urgent);
  return s == nullptr ? now : events_[s->event - first_event_].packed_at;
}

std::optional<EventSegment> EventSender::Next(Time now, bool urgent) const {
  const Segment* s = NextDue(now, urgent);
  if (s == nullptr) return std::nullopt;
  const Event& event = events_[s->event - first_event_];
  EventSegment out;
  out.number = s->number;
  out.base = s == &segments_.front();
  out.first = s->offset == 0;
  const std::size_t size = std::min(kSegmentBytes, event.packed.size() - s->offset);
  out.last = s->offset + size == event.packed.size();
  if (out.first) out.age = now - event.packed_at;
  out.bits = out.last ? event.bits - 8 * s->offset : 8 * size;
  const auto from = event.packed.begin() + static_cast<std::ptrdiff_t>(s->offset);
  out.bytes.assign(from, from + static_cast<std::ptrdiff_t>(size));
  return out;
}

EventSender::Segment* EventSender::Find(std::uint8_t number) {
  if (segments_.empty()) return nullptr;
  const std::size_t index = static_cast<std::uint8_t>(number - segments_.front().number);
  return index < segments_.size() && index < kEventWindow ? &segments_[index] : nullptr;
}

void EventSender::MarkSent(std::uint8_t number, Time now, Time leaves_at) {
  Segment* s = Find(number);
  if (s == nullptr) return;
  events_[s->event - first_event_].released = true;
  s->sent = true;
  s->begun_at = now;
  s->sent_at = leaves_at;
  if (++s->times > 1) ++resent_;
}

void EventSender::MarkUnsent(std::uint8_t number) {
  Segment* s = Find(number);
  if (s == nullptr) return;
  s->sent = false;
  if (s->times-- > 1) --resent_;
}

std::size_t EventSender::OnAck(const EventAck& ack, Time now, RoundTrip& round_trip) {
  if (segments_.empty()) return 0;
  const std::size_t done = static_cast<std::uint8_t>(ack.next - segments_.front().number);
  // Outside of what is under way: an old acknowledgement.
  if (done > std::min(segments_.size(), kEventWindow)) return 0;
  Time newest_seen{Time::min()};
  const std::size_t missing = done + ack.prefix;
  const std::size_t n = std::min({segments_.size(), kEventWindow, missing + 1 + kAckWindow});
  for (std::size_t i = 0; i < n; ++i) {
    Segment& s = segments_[i];
    const bool there = i < missing || (i > missing && (ack.held >> (i - missing - 1) & 1U) != 0);
    if (there && s.sent) {
      newest_seen = std::max(newest_seen, s.sent_at);
      if (!s.held && s.times == 1) round_trip.Sample(now - s.sent_at);
    }
    s.held = there;  // a restarted receiver has lost what it held: sent again
  }
  // Bytes keep their order on a line: what was sent before something that arrived is lost.
  for (std::size_t i = done; i < n; ++i)
    if (!segments_[i].held && segments_[i].sent && segments_[i].sent_at < newest_seen)
      segments_[i].sent = false;
  std::size_t events = 0;
  for (std::size_t i = 0; i < done; ++i) {
    const std::size_t event = segments_.front().event;
    segments_.pop_front();
    if (!segments_.empty() && segments_.front().event == event) continue;
    events_.pop_front();
    ++first_event_;
    ++events;
  }
  return events;
}

void EventSender::ResendAll(bool forgotten) {
  for (Segment& s : segments_) {
    s.sent = false;
    s.held = s.held && !forgotten;
  }
}

std::optional<Time> EventSender::oldest() const {
  if (events_.empty()) return std::nullopt;
  return events_.front().packed_at;
}

std::vector<EventReceiver::Event> EventReceiver::OnSegment(const EventSegment& segment, Time sent_at) {
  const bool is_begin = segment.base && segment.first;
  if (!known_) {
    if (!is_begin) return {};
    known_ = true;
    next_ = segment.number;
  }
  ack_due_ = true;
  const int difference = static_cast<std::uint8_t>(segment.number - next_);
  const int ahead = difference < 128 ? difference : difference - 256;
  if (ahead < 0) return {};  // delivered before, its acknowledgement was lost
  // The sender has an acknowledgement for everything before: this end's memory is older than that.
  if (ahead > 0 && is_begin) Advance(static_cast<std::size_t>(ahead));
  const auto slot = static_cast<std::size_t>(static_cast<std::uint8_t>(segment.number - next_));
  if (slot >= kEventWindow) return {};
  if (!held_[slot]) held_[slot] = Held{segment, sent_at - segment.age};

  std::vector<Event> events;
  while (auto event = TakeComplete()) events.push_back(std::move(*event));
  return events;
}

std::optional<EventReceiver::Event> EventReceiver::TakeComplete() {
  if (!held_[0] || !held_[0]->segment.first) return std::nullopt;
  std::size_t n = 0;
  while (n < kEventWindow && held_[n] && !held_[n]->segment.last) ++n;
  if (n == kEventWindow || !held_[n]) return std::nullopt;
  Event event{.packed = {}, .bits = 0, .packed_at = held_[0]->packed_at};
  for (std::size_t i = 0; i <= n; ++i) {
    const EventSegment& s = held_[i]->segment;
    event.packed.insert(event.packed.end(), s.bytes.begin(), s.bytes.end());
    event.bits += s.bits;
  }
  Advance(n + 1);
  return event;
}

void EventReceiver::Advance(std::size_t segments) {
  next_ = static_cast<std::uint8_t>(next_ + segments);
  for (std::size_t i = 0; i < kEventWindow; ++i)
    held_[i] = i + segments < kEventWindow ? std::move(held_[i + segments]) : std::nullopt;
}

void EventReceiver::Forget() {
  held_.fill(std::nullopt);
  known_ = false;
  ack_due_ = false;
}

EventAck EventReceiver::ack() const {
  EventAck ack{.next = next_, .prefix = 0, .held = 0};
  while (ack.prefix < kEventWindow && held_[ack.prefix]) ++ack.prefix;
  for (std::size_t i = 0; i < kAckWindow && ack.prefix + 1 + i < kEventWindow; ++i)
    if (held_[ack.prefix + 1 + i]) ack.held |= static_cast<std::uint16_t>(1U << i);
  return ack;
}

}  // namespace priamos::bus::radio
