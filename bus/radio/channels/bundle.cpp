#include "bus/radio/channels/bundle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace priamos::bus::radio {
namespace {

enum ControlKind : std::uint8_t {
  kFrameAck = 0,
  kEventAck = 1,
  kFloor = 2,
  kListen = 3,
  kOver = 4,
  kForget = 5,
  kNextKey = 6
};
constexpr int kControlKindBits = 3;
constexpr int kLengthBits = 8;
constexpr int kSegmentLengthBits = 5;
constexpr int kPrefixBits = 6;
constexpr int kOffsetBits = 6;
constexpr int kFloorBits = 40;
constexpr int kKeyCheckBits = 32;
constexpr int kLossSteps = 15;

/// Quotient rounded down, also below zero.
constexpr std::int64_t FloorDivide(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

std::uint64_t EncodeOffset(Duration offset, Duration ttl) {
  const std::int64_t steps = FloorDivide(offset.count() * kOffsetSteps, ttl.count());
  return static_cast<std::uint64_t>(std::clamp(steps, -kOffsetSteps, kOffsetSteps - 1) + kOffsetSteps);
}

/// The least number of microseconds that has this code.
Duration DecodeOffset(std::uint64_t code, Duration ttl) {
  return Duration(-FloorDivide((kOffsetSteps - static_cast<std::int64_t>(code)) * ttl.count(), kOffsetSteps));
}

/// Whether all events of a channel have one segment, and one size.
bool AlwaysOneSegment(const LinkChannel& c) {
  return c.fixed_bits > 0 && c.fixed_bits <= 8 * kSegmentBytes;
}

/// The run that a segment begins or goes on; nullopt for an urgent one.
std::optional<EventRun> RunAfter(const ChannelTable& table, const EventEntry& e) {
  if (table.at(e.channel).urgent) return std::nullopt;
  return EventRun{e.channel, static_cast<std::uint8_t>(e.segment.number + 1)};
}

/// Writes one kind of entry.
class EntryWriter {
 public:
  /// Writer to `out`. `follows`: the entry is a segment that goes on a run.
  EntryWriter(const ChannelTable& table, BitWriter& out, bool follows)
      : table_(table), out_(out), follows_(follows) {}

  void operator()(const StateEntry& e) {
    Id(e.channel);
    if (!table_.at(e.channel).delta.empty()) out_.Put(e.baseline ? 1 : 0, 1);
    if (e.baseline) {
      out_.Put(*e.baseline, kBaselineBits);
      out_.Append(e.packed, e.bits);
      return;
    }
    Body(e.channel, e.bits, e.packed);
  }
  void operator()(const CommandEntry& e) {
    Id(e.channel);
    out_.Put(EncodeOffset(e.offset, table_.at(e.channel).ttl), kOffsetBits);
    Body(e.channel, e.bits, e.packed);
  }
  void operator()(const EventEntry& e) {
    const EventSegment& s = e.segment;
    if (!follows_) {
      Id(e.channel);
      out_.Put(s.number, 8);
      out_.Put(s.base ? 1 : 0, 1);
    }
    if (AlwaysOneSegment(table_.at(e.channel))) {
      out_.Put(EncodeDuration12(s.age), 12);
      out_.Append(s.bytes, s.bits);
      return;
    }
    out_.Put(s.first ? 1 : 0, 1);
    out_.Put(s.last ? 1 : 0, 1);
    if (s.first) out_.Put(EncodeDuration12(s.age), 12);
    if (s.last) out_.Put(s.bytes.size(), kSegmentLengthBits);
    out_.Append(s.bytes, s.bytes.size() * 8);
  }
  void operator()(const EventAckEntry& e) {
    Control(kEventAck);
    Id(e.channel);
    out_.Put(e.ack.next, 8);
    out_.Put(e.ack.prefix, kPrefixBits);
    out_.Put(e.ack.held != 0 ? 1 : 0, 1);
    if (e.ack.held != 0) out_.Put(e.ack.held, static_cast<int>(kAckWindow));
  }
  void operator()(const FrameAckEntry& e) {
    Control(kFrameAck);
    out_.Put(e.counter & 0xFFFU, 12);
    out_.Put(e.earlier, kEarlierFrames);
    out_.Put(EncodeDuration12(e.hold), 12);
    out_.Put(static_cast<std::uint64_t>(std::lround(std::clamp(e.loss, 0.0, 1.0) * kLossSteps)), 4);
  }
  void operator()(const FloorEntry& e) { Control(kFloor, e.counter, kFloorBits); }
  void operator()(const ListenEntry& e) { Control(kListen, e.channels, static_cast<int>(table_.size())); }
  void operator()(const OverEntry&) { Control(kOver); }
  void operator()(const ForgetEntry&) { Control(kForget); }
  void operator()(const NextKeyEntry& e) { Control(kNextKey, e.check, kKeyCheckBits); }

 private:
  void Id(std::size_t channel) { out_.Put(channel + 1, table_.id_bits()); }
  void Control(ControlKind kind) {
    out_.Put(table_.size() + 1, table_.id_bits());
    out_.Put(kind, kControlKindBits);
  }
  void Control(ControlKind kind, std::uint64_t value, int bits) {
    Control(kind);
    out_.Put(value, bits);
  }
  void Body(std::size_t channel, std::size_t bits, std::span<const std::byte> packed) {
    if (table_.at(channel).fixed_bits > 0) {
      out_.Append(packed, bits);
    } else {
      out_.Put(packed.size(), kLengthBits);
      out_.Append(packed, packed.size() * 8);
    }
  }
  const ChannelTable& table_;
  BitWriter& out_;
  bool follows_;
};

class BundleReader {
 public:
  BundleReader(const ChannelTable& table, Direction incoming, std::span<const std::byte> bundle)
      : table_(table), incoming_(incoming), in_(bundle) {}

  /// The next entry; nullopt at the end (ok() is true) or where reading cannot go on (false).
  std::optional<BundleEntry> Next() {
    if (const auto run = std::exchange(run_, std::nullopt); run && in_.left() > 0 && in_.Get(1) != 0)
      return Whole(Event(run->channel, run->number, false));
    if (in_.left() < static_cast<std::size_t>(table_.id_bits())) return std::nullopt;
    const std::uint64_t id = in_.Get(table_.id_bits());
    if (id == 0) return std::nullopt;
    return Whole(id == table_.size() + 1 ? Control() : Message(id - 1));
  }
  bool ok() const { return ok_; }

 private:
  struct Packed {
    std::size_t bits = 0;
    std::vector<std::byte> bytes;
  };
  /// The entry, unless it could not be read.
  std::optional<BundleEntry> Whole(std::optional<BundleEntry> entry) {
    ok_ = ok_ && entry && in_.ok();
    return ok_ ? std::move(entry) : std::nullopt;
  }
  std::optional<BundleEntry> Message(std::size_t channel) {
    if (channel >= table_.size() || table_.at(channel).direction != incoming_) return std::nullopt;
    const LinkChannel& c = table_.at(channel);
    switch (c.channel_class) {
      case ChannelClass::kState:
        return State(channel, c);
      case ChannelClass::kCommand: {
        const Duration offset = DecodeOffset(in_.Get(kOffsetBits), c.ttl);
        Packed body = Body(c);
        return CommandEntry{channel, offset, body.bits, std::move(body.bytes)};
      }
      case ChannelClass::kEvent:
        return FirstEvent(channel);
    }
    return std::nullopt;
  }
  StateEntry State(std::size_t channel, const LinkChannel& c) {
    if (c.delta.empty() || in_.Get(1) == 0) {
      Packed body = Body(c);
      return {channel, body.bits, std::move(body.bytes)};
    }
    const auto baseline = static_cast<std::uint8_t>(in_.Get(kBaselineBits));
    const std::size_t before = in_.left();
    std::vector<std::byte> delta = TakeDelta(c.delta, in_);
    return {channel, before - in_.left(), std::move(delta), baseline};
  }
  Packed Body(const LinkChannel& c) {
    const std::size_t bits = c.fixed_bits > 0 ? c.fixed_bits : in_.Get(kLengthBits) * 8;
    return {bits, in_.Take(bits)};
  }
  EventEntry FirstEvent(std::size_t channel) {
    const auto number = static_cast<std::uint8_t>(in_.Get(8));
    const bool base = in_.Get(1) != 0;
    return Event(channel, number, base);
  }
  /// The rest of a segment.
  EventEntry Event(std::size_t channel, std::uint8_t number, bool base) {
    const LinkChannel& c = table_.at(channel);
    EventEntry entry{channel, {}};
    EventSegment& s = entry.segment;
    s.number = number;
    s.base = base;
    const bool one = AlwaysOneSegment(c);
    s.first = one || in_.Get(1) != 0;
    s.last = one || in_.Get(1) != 0;
    if (s.first) s.age = DecodeDuration12(static_cast<std::uint16_t>(in_.Get(12)));
    s.bits = one ? c.fixed_bits : 8 * (s.last ? in_.Get(kSegmentLengthBits) : kSegmentBytes);
    s.bytes = in_.Take(s.bits);
    run_ = RunAfter(table_, entry);
    return entry;
  }
  std::optional<BundleEntry> Control() {
    switch (in_.Get(kControlKindBits)) {
      case kFrameAck: {
        FrameAckEntry e;
        e.counter = static_cast<std::uint16_t>(in_.Get(12));
        e.earlier = static_cast<std::uint8_t>(in_.Get(kEarlierFrames));
        e.hold = DecodeDuration12(static_cast<std::uint16_t>(in_.Get(12)));
        e.loss = static_cast<double>(in_.Get(4)) / kLossSteps;
        return e;
      }
      case kEventAck:
        return Acknowledgement();
      case kFloor:
        return FloorEntry{in_.Get(kFloorBits)};
      case kListen:
        return ListenEntry{in_.Get(static_cast<int>(table_.size()))};
      case kOver:
        return OverEntry{};
      case kForget:
        return ForgetEntry{};
      case kNextKey:
        return NextKeyEntry{static_cast<std::uint32_t>(in_.Get(kKeyCheckBits))};
      default:
        return std::nullopt;
    }
  }
  std::optional<BundleEntry> Acknowledgement() {
    const std::uint64_t id = in_.Get(table_.id_bits());
    if (id == 0 || id > table_.size()) return std::nullopt;
    const LinkChannel& c = table_.at(id - 1);
    if (c.direction == incoming_ || c.channel_class != ChannelClass::kEvent) return std::nullopt;
    EventAckEntry e{id - 1, {}};
    e.ack.next = static_cast<std::uint8_t>(in_.Get(8));
    e.ack.prefix = static_cast<std::uint8_t>(in_.Get(kPrefixBits));
    if (in_.Get(1) != 0) e.ack.held = static_cast<std::uint16_t>(in_.Get(static_cast<int>(kAckWindow)));
    return e;
  }

  const ChannelTable& table_;
  Direction incoming_;
  BitReader in_;
  std::optional<EventRun> run_;
  bool ok_ = true;
};

}  // namespace

std::uint16_t EncodeDuration12(Duration d) {
  const double ms = std::max(0.0, Seconds(d) * 1e3);
  for (unsigned exponent = 0; exponent < 8; ++exponent) {
    const auto mantissa =
        static_cast<std::uint64_t>(std::round(ms / static_cast<double>(1U << (2 * exponent))));
    if (mantissa < 512) return static_cast<std::uint16_t>(exponent << 9 | mantissa);
  }
  return 0xFFF;
}

Duration DecodeDuration12(std::uint16_t code) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(code & 0x1FF) << (2 * (code >> 9 & 7)));
}

void BundleWriter::Write(const BundleEntry& entry) {
  const auto* event = std::get_if<EventEntry>(&entry);
  const bool follows = run_ && event != nullptr && event->channel == run_->channel &&
                       event->segment.number == run_->number && !event->segment.base;
  if (run_) out_.Put(follows ? 1 : 0, 1);
  std::visit(EntryWriter(*table_, out_, follows), entry);
  run_ = event != nullptr ? RunAfter(*table_, *event) : std::nullopt;
}

std::size_t BundleWriter::BitsWith(const BundleEntry& entry) const {
  BundleWriter added(*table_);
  added.run_ = run_;
  added.Write(entry);
  return bits() + added.bits();
}

ParsedBundle ParseBundle(const ChannelTable& table, Direction incoming, std::span<const std::byte> bundle) {
  BundleReader reader(table, incoming, bundle);
  ParsedBundle parsed;
  while (auto entry = reader.Next()) parsed.entries.push_back(std::move(*entry));
  parsed.whole = reader.ok();
  return parsed;
}

}  // namespace priamos::bus::radio
