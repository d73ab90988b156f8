#include "bus/radio/budget_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/channels/entry_sizes.hpp"
#include "bus/radio/frame/coded_block.hpp"
#include "bus/radio/frame_length.hpp"
#include "bus/radio/line/repetition.hpp"

namespace priamos::bus::radio {
namespace {

/// Bytes of a frame beside its bundle, with the delimiter that leads after silence.
constexpr std::size_t kLeadingDelimiter = 1;
constexpr double kNotBounded_s = 60;
/// Bytes are handed to the line once per tick.
constexpr double kTick_s = 0.001;
/// Half-duplex: time from the end of one end's turn to the reaction of the other one.
constexpr double kHandOver_s = 2 * kTick_s;
/// Acknowledgements of frames per second, at most.
constexpr double kFrameAcks_hz = 4;
/// Announcements of listeners per second, at most.
constexpr double kAnnouncements_hz = 1;
constexpr int kFrameAckBits = 3 + 12 + kEarlierFrames + 12 + 4;
constexpr int kEventAckBits = 3 + 8 + 6 + 1 + static_cast<int>(kAckWindow);
constexpr int kControlKindBits = 3;

}  // namespace

double ChannelLoad::Arrivals(double window_s) const {
  return keys * (burst + std::floor(window_s / period_s));
}

double ChannelLoad::OwnBefore(double window_s) const {
  return entries > 1 || burst > 1 || keys > 1 ? Arrivals(window_s) - 1 : std::floor(window_s / period_s);
}

DirectionAnalysis::DirectionAnalysis(const ChannelTable& table, const LinkOptions& options,
                                     Direction direction)
    : table_(table),
      direction_(direction),
      byte_s_(1 / options.bytes_per_s),
      duty_(options.duty),
      datagrams_(options.datagrams),
      packets_(options.packets()),
      ageing_s_(Seconds(options.ageing)),
      frame_bytes_(
          FrameOverhead(table.code_bytes()) + (options.datagrams ? options.HeadBytes() : kLeadingDelimiter) +
          (table.HasCommands(direction) ? EchoBytes(options.bytes_per_s) : 0) + (options.robots > 0 ? 1 : 0)),
      ahead_s_((options.ahead_bytes + 4) * byte_s_),
      keep_alive_s_(Seconds(options.keep_alive)) {
  const FrameLength length = FrameLengthOf(table, options, direction);
  const auto bundle_bytes = static_cast<double>(length.bundle_bytes);
  double largest = bundle_bytes;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).direction != direction) continue;
    loads_.push_back(LoadOf(i));
    largest_bits_ = std::max({largest_bits_, loads_.back().entry_bits, loads_.back().single_bits});
  }
  largest = std::max(largest, std::ceil(largest_bits_ / 8));
  control_bits_ = ControlBits();
  if (options.robots > 0) control_bits_ += OverBits();
  if (length.strict) ConfineTo(bundle_bytes, largest);
  if (options.half_duplex.turn > Duration::zero()) ShareTheAir(options);
  bundle_bits_ = 8 * bundle_bytes;
  capacity_bits_ = bundle_bits_ - control_bits_;
  frame_s_ = FrameSeconds(8 * largest + control_bits_);
  const double longest_bits = std::min(8 * largest + control_bits_, 8.0 * kMaxBundleBytes);
  const std::size_t beside = frame_bytes_ - (options.datagrams ? options.HeadBytes() : kLeadingDelimiter);
  longest_bytes_ =
      std::max(kHelloFrameBytes + (options.robots > 0 ? 1 : 0),
               beside + kWholeCounterBytes + static_cast<std::size_t>(std::ceil(longest_bits / 8)));
  overhead_ =
      1 + static_cast<double>(frame_bytes_ - (options.datagrams ? 0 : kLeadingDelimiter)) / bundle_bytes;
}

double DirectionAnalysis::ControlBytesPerSecond() const {
  const double acks_hz = robots_ > 0 ? std::min(kFrameAcks_hz, 1 / Seconds(polled_.cycle)) : kFrameAcks_hz;
  double bits = acks_hz * (table_.id_bits() + kFrameAckBits);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.direction == direction_ || c.channel_class != ChannelClass::kEvent || c.urgent) continue;
    const ChannelLoad incoming = LoadOf(i);
    // One per frame that brings some of the event.
    const double frames = std::ceil(incoming.bits / capacity_bits_);
    bits += frames / incoming.period_s * (2 * table_.id_bits() + kEventAckBits);
  }
  double bytes = bits / 8 * overhead_;
  for (const ChannelLoad& incoming : answered_) bytes += AckFrameSeconds() / byte_s_ / incoming.period_s;
  return bytes;
}

double DirectionAnalysis::BytesPerSecond(const ChannelLoad& load) const {
  if (robots_ > 0 && load.command) return 0;  // the newest, in frames that a robot gets beside its share
  if (robots_ > 0) return load.bits / 8 * overhead_ * load.keys / load.period_s;
  const double bytes = load.repeated ? AllFramesSeconds(load) / byte_s_ : load.bits / 8 * overhead_;
  return bytes * load.keys / load.period_s;
}

ChannelLoad DirectionAnalysis::LoadOf(std::size_t index) const {
  const LinkChannel& c = table_.at(index);
  ChannelLoad load;
  load.channel = index;
  load.urgent = c.urgent;
  load.newest_only = c.channel_class != ChannelClass::kEvent;
  load.command = c.channel_class == ChannelClass::kCommand;
  load.repeated = c.urgent && c.channel_class == ChannelClass::kEvent;
  load.priority = c.priority;
  load.period_s = c.rate_hz > 0 ? 1 / c.rate_hz : std::numeric_limits<double>::infinity();
  load.burst = c.burst;
  load.keys = c.max_keys;
  const EntrySizes sizes = SizesOf(table_, index);
  load.entries = sizes.entries;
  load.entry_bits = sizes.entry_bits;
  load.bits = sizes.bits;
  load.single_bits = sizes.single_bits;
  return load;
}

/// Acknowledgements that can be in one frame before the messages.
double DirectionAnalysis::ControlBits() const {
  double bits = table_.id_bits() + kFrameAckBits;
  bool on_request = false;
  bool deltas = false;
  for (const LinkChannel& c : table_.channels()) {
    if (c.direction == direction_) continue;
    if (c.channel_class == ChannelClass::kEvent) bits += 2 * table_.id_bits() + kEventAckBits;
    on_request = on_request || c.on_request;
    deltas = deltas || !c.delta.empty();
  }
  if (deltas) bits += table_.id_bits() + kControlKindBits;
  if (on_request) bits += table_.id_bits() + kControlKindBits + static_cast<double>(table_.size());
  return bits;
}

/// Acknowledgements and announcements of listeners that can be in the frames of a window.
double DirectionAnalysis::ControlEntriesIn(double window_s) const {
  double entries = 2 + std::floor(window_s * kFrameAcks_hz) + std::floor(window_s * kAnnouncements_hz);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.direction == direction_ || c.channel_class != ChannelClass::kEvent) continue;
    const ChannelLoad incoming = LoadOf(i);
    entries += incoming.Arrivals(window_s) * incoming.entries;
  }
  return entries;
}

/// Bits of these.
double DirectionAnalysis::ControlBitsIn(double window_s) const {
  double bits = (1 + std::floor(window_s * kFrameAcks_hz)) * (table_.id_bits() + kFrameAckBits);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.direction == direction_ || c.channel_class != ChannelClass::kEvent) continue;
    const ChannelLoad incoming = LoadOf(i);
    bits += incoming.Arrivals(window_s) * incoming.entries * (2 * table_.id_bits() + kEventAckBits);
  }
  const double announcement_bits = table_.id_bits() + kControlKindBits + static_cast<double>(table_.size());
  return bits + (1 + std::floor(window_s * kAnnouncements_hz)) * announcement_bits;
}

/// Turns that end a frame early, and the time in between when the other end uses all of its turn.
void DirectionAnalysis::ShareTheAir(const LinkOptions& options) {
  const double longest_s = FrameSeconds(8.0 * static_cast<double>(options.max_bundle_bytes));
  const double alone_s = FrameSeconds(8.0 * static_cast<double>(kMaxBundleBytes)) - longest_s;
  turn_s_ = Seconds(options.half_duplex.turn) - longest_s;
  gap_s_ = Seconds(options.half_duplex.turn) + alone_s +
           2 * (Seconds(options.half_duplex.turnaround) + kHandOver_s);
  control_bits_ += table_.id_bits() + kControlKindBits;  // "over"
}

/// "Over", and the bit that ends a run of segments before it.
double DirectionAnalysis::OverBits() const {
  return table_.id_bits() + kControlKindBits + 1;
}

/// No message makes such a frame longer, and acknowledgements leave room for one.
void DirectionAnalysis::ConfineTo(double bundle_bytes, double& largest_bytes) {
  const double bits = 8 * bundle_bytes;
  control_bits_ = std::min(control_bits_, std::max(0.0, bits - largest_bits_));
  largest_bytes = (bits - control_bits_) / 8;
}

void DirectionAnalysis::SetPolled(const PollBounds& bounds, int robots) {
  polled_ = bounds;
  robots_ = robots;
  turn_s_ = Seconds(LongestFrameTime());
  gap_s_ = Seconds(bounds.cycle) - turn_s_;
}

std::size_t DirectionAnalysis::SmallestBundleBytes() const {
  const double ack_bits = std::max(table_.id_bits() + kFrameAckBits, 2 * table_.id_bits() + kEventAckBits);
  return static_cast<std::size_t>(std::ceil((largest_bits_ + ack_bits + OverBits()) / 8));
}

Duration DirectionAnalysis::LongestFrameTime() const {
  return FromSeconds(static_cast<double>(longest_bytes_ + kLeadingDelimiter) * byte_s_);
}

double DirectionAnalysis::UrgentFrameSeconds() const {
  double longest_s = 0;
  for (const ChannelLoad& load : loads_)
    if (load.urgent) longest_s = std::max(longest_s, FrameSeconds(load.bits));
  return longest_s;
}

double DirectionAnalysis::SilenceSeconds() const {
  if (robots_ > 0) return Seconds(polled_.asked) + frame_s_;
  return std::max({keep_alive_s_, gap_s_, duty_.limited() ? frame_s_ / duty_.rate() : 0}) + frame_s_;
}

double DirectionAnalysis::CreditSeconds() const {
  double s = frame_s_;
  for (const ChannelLoad& load : loads_)
    if (load.urgent) s += load.Arrivals(0) * AllFramesSeconds(load);
  for (const ChannelLoad& incoming : answered_) s += incoming.Arrivals(0) * AckFrameSeconds();
  return s;
}

double DirectionAnalysis::NextSeconds(const ChannelLoad& load) const {
  if (robots_ > 0) return Seconds(polled_.asked) + FrameSeconds(load.bits) + kTick_s;
  return InTurns(frame_s_ / duty_.rate() + FrameSeconds(load.bits) + ahead_s_ + kTick_s);
}

double DirectionAnalysis::AheadSeconds() const {
  return ahead_s_ + kTick_s + (packets_ ? frame_s_ : 0);
}

/// When work that takes `work_s` on the line is done.
double DirectionAnalysis::InTurns(double work_s) const {
  return gap_s_ > 0 ? work_s + gap_s_ * (1 + std::floor(work_s / turn_s_)) : work_s;
}

double DirectionAnalysis::FrameSeconds(double bits) const {
  return (static_cast<double>(frame_bytes_) + std::ceil(bits / 8)) * byte_s_;
}

/// A frame that only acknowledges urgent events.
double DirectionAnalysis::AckFrameSeconds() const {
  double bits = 0;
  for (const LinkChannel& c : table_.channels())
    if (c.direction != direction_ && c.urgent && c.channel_class == ChannelClass::kEvent)
      bits += 2 * table_.id_bits() + kEventAckBits;
  return FrameSeconds(bits);
}

/// Longest time from the arrival of an urgent event to the end of the frame with its acknowledgement: the
/// next one.
double DirectionAnalysis::AnswerSeconds() const {
  return InTurns(ahead_s_ + kTick_s + frame_s_ + UrgentFrameSeconds() + AckFrameSeconds());
}

/// A repetition of an urgent event: a block that corrects errors, where it fits one.
double DirectionAnalysis::RepeatedFrameSeconds(double bits) const {
  // Two bytes beside the content: COBS's code byte and the delimiter.
  const std::size_t content =
      frame_bytes_ - kLeadingDelimiter - 2 + static_cast<std::size_t>(std::ceil(bits / 8));
  const std::size_t block = datagrams_ ? 0 : BlockBytes(content);
  if (block == 0) return FrameSeconds(bits);
  return static_cast<double>(EncodedBlockBytes(block) + 1 + kLeadingDelimiter) * byte_s_;
}

/// All frames with the same urgent event: the first, repetitions until it is acknowledged, and the one that
/// is on the line then. After kRepeatAtOnce they take half of the line.
double DirectionAnalysis::AllFramesSeconds(const ChannelLoad& load) const {
  if (!load.repeated) return FrameSeconds(load.bits);
  constexpr double at_once_s = 1e-6 * static_cast<double>(kRepeatAtOnce.count());
  const double busy_s = std::min(repeat_s_, at_once_s) + std::max(0.0, repeat_s_ - at_once_s) / 2;
  const double repeated_s = RepeatedFrameSeconds(load.bits);
  return FrameSeconds(load.bits) + (1 + std::floor(busy_s / repeated_s)) * repeated_s;
}

void DirectionAnalysis::Solve(const DirectionAnalysis& other, double line_delay_s) {
  repeat_s_ = line_delay_s + other.AnswerSeconds() + kTick_s;
  for (const ChannelLoad& incoming : other.loads_)
    if (incoming.repeated) answered_.push_back(incoming);
  // Latencies only grow when more overtake, so this ends.
  for (bool changed = true; changed;) {
    std::vector<double> latencies;
    for (const ChannelLoad& load : loads_) latencies.push_back(load.urgent ? Urgent(load) : Ordinary(load));
    changed = false;
    for (std::size_t i = 0; i < loads_.size(); ++i) {
      changed = changed || loads_[i].latency_s != latencies[i];
      loads_[i].latency_s = latencies[i];
    }
    solved_once_ = true;
  }
}

bool DirectionAnalysis::GoesBefore(const ChannelLoad& other, const ChannelLoad& load) const {
  if (other.priority <= load.priority) return true;
  // Before the first solution nobody is late; later, who waits longer than the levels between overtakes.
  return solved_once_ && other.latency_s >= (other.priority - load.priority) * ageing_s_;
}

/// The station's urgent messages wait for one slot and for those to the other robots; a robot's for its turn.
double DirectionAnalysis::PolledUrgent(const ChannelLoad& load) const {
  const bool down = direction_ == Direction::kDown;
  return Converge([&](double window_s) {
    double s = 0;
    for (const ChannelLoad& other : loads_) {
      if (!other.urgent) continue;
      const double frames = &other == &load ? 1 + load.OwnBefore(window_s) : other.Arrivals(window_s);
      s += frames * (down ? robots_ * (FrameSeconds(other.bits) + kTick_s) : Seconds(polled_.cycle));
    }
    return s + Seconds(polled_.slot) + kTick_s;
  });
}

/// What urgent events take of the channel. Each to a robot is a frame, and a poll of that robot which follows
/// at once and brings its acknowledgement. Before each of these polls, and before the next, the event is sent
/// again to all robots that still have one to acknowledge: when it went to n robots, to n - 1 after the first
/// poll, to n - 2 after the second; and to n - 1 each time while new ones come to those that were polled.
double DirectionAnalysis::PolledUrgentIn(double window_s) const {
  const bool down = direction_ == Direction::kDown;
  const double robots = robots_;
  double to_each = 0;  // urgent events of the station to every robot
  double of_each = 0;
  for (const ChannelLoad& own : loads_)
    if (own.urgent) (down ? to_each : of_each) += own.Arrivals(window_s);
  for (const ChannelLoad& incoming : answered_) (down ? of_each : to_each) += incoming.Arrivals(window_s);
  const double repeated = robots * (robots - 1) * std::max(0.0, to_each - 0.5);
  const double frames = robots * (to_each + of_each) + repeated;
  return frames * Seconds(polled_.urgent) + robots * (to_each + of_each) * Seconds(polled_.slot);
}

std::optional<Duration> DirectionAnalysis::BesideUrgent(Duration turn) const {
  const double s = Converge([&](double window_s) { return Seconds(turn) + PolledUrgentIn(window_s); });
  return std::isfinite(s) ? std::optional(FromSeconds(s)) : std::nullopt;
}

/// One frame goes per cycle; to each urgent event one may be lost, for its repetition or acknowledgement.
/// Commands are no load on that: a robot that gets them is polled more often.
double DirectionAnalysis::PolledIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const {
  double turns = 1 + FramesBefore(window_s, load, waiting);
  for (const ChannelLoad& other : loads_)
    if (other.urgent) turns += other.Arrivals(window_s);
  for (const ChannelLoad& incoming : answered_) turns += incoming.Arrivals(window_s);
  return turns * Seconds(polled_.cycle) + PolledUrgentIn(window_s) + CrowdedOutSeconds(load) +
         Seconds(polled_.slot) + kTick_s;
}

/// How long a message waits that has no room beside a command: until its age lets it go before.
double DirectionAnalysis::CrowdedOutSeconds(const ChannelLoad& load) const {
  double s = 0;
  for (const ChannelLoad& other : loads_)
    if (other.command && other.entry_bits + std::max(load.entry_bits, load.single_bits) > capacity_bits_)
      s = std::max(s, (1 + std::max(0, load.priority - other.priority)) * ageing_s_);
  return s;
}

double DirectionAnalysis::Urgent(const ChannelLoad& load) const {
  if (robots_ > 0) return PolledUrgent(load);
  double blocking_s = packets_ ? frame_s_ : 0;
  for (const ChannelLoad& other : loads_)
    if (other.urgent && &other != &load) blocking_s = std::max(blocking_s, FrameSeconds(other.bits));
  return Converge([&](double window_s) {
    double s = ahead_s_ + kTick_s + blocking_s + FrameSeconds(load.bits) * load.OwnBefore(window_s);
    for (const ChannelLoad& other : loads_)
      if (other.urgent && &other != &load && other.priority <= load.priority)
        s += other.Arrivals(window_s) * FrameSeconds(other.bits);
    for (const ChannelLoad& incoming : answered_) s += incoming.Arrivals(window_s) * AckFrameSeconds();
    return s + FrameSeconds(load.bits);
  });
}

/// Of the largest message, or of one of a single entry that is longer than its entries.
double DirectionAnalysis::Ordinary(const ChannelLoad& load) const {
  if (robots_ > 0 && load.command)
    return Converge([&](double window_s) { return NextSeconds(load) + PolledUrgentIn(window_s); });
  const double largest_s =
      Ordinary(load, {.entries = load.entries, .entry_bits = load.entry_bits, .bits = load.bits});
  if (load.single_bits <= 0) return largest_s;
  return std::max(largest_s,
                  Ordinary(load, {.entries = 1, .entry_bits = load.single_bits, .bits = load.single_bits}));
}

double DirectionAnalysis::Ordinary(const ChannelLoad& load, const Waiting& waiting) const {
  return Converge([&](double window_s) {
    return robots_ > 0 ? PolledIn(window_s, load, waiting) : OrdinaryIn(window_s, load, waiting);
  });
}

/// Frames that leave a message out which waits for `window_s`, at most, with those that take its earlier
/// segments. Such a frame is full: what it has of other messages and of acknowledgements leaves no room for
/// this one. Of a channel of which the newest message alone waits it has one per key, however many come.
double DirectionAnalysis::FramesBefore(double window_s, const ChannelLoad& load,
                                       const Waiting& waiting) const {
  std::vector<Ahead> ahead{OwnAhead(window_s, load, waiting)};
  for (const ChannelLoad& other : loads_) {
    if (&other == &load || other.urgent || (robots_ > 0 && other.command) || !GoesBefore(other, load))
      continue;
    const double n = other.Arrivals(window_s);
    ahead.push_back({.entries = n * other.entries, .bits = n * other.bits});
    if (other.newest_only) ahead.back().most_bits = other.keys * other.bits;
  }
  // Either every frame is full of acknowledgements, or they are counted like messages.
  const double reserved = FramesAhead(ahead, capacity_bits_ - waiting.entry_bits + 1);
  if (robots_ > 0 || gap_s_ > 0) return reserved;
  ahead.push_back({.entries = ControlEntriesIn(window_s), .bits = ControlBitsIn(window_s)});
  return std::min(reserved, FramesAhead(ahead, bundle_bits_ - waiting.entry_bits + 1));
}

/// The messages of the same channel before this one, and its own first segments. A state that waits is
/// replaced by the newer one.
Ahead DirectionAnalysis::OwnAhead(double window_s, const ChannelLoad& load, const Waiting& waiting) {
  const double own = load.newest_only ? load.keys - 1 : load.OwnBefore(window_s);
  return {.entries = waiting.entries - 1 + own * load.entries,
          .bits = waiting.bits - waiting.entry_bits + own * load.bits};
}

/// What the frames before a message can hold: what goes before it, and what goes after it but has room where
/// this one had none, because it is shorter.
double DirectionAnalysis::BitsBefore(double window_s, const ChannelLoad& load, const Waiting& waiting) const {
  double bits = OwnAhead(window_s, load, waiting).bits;
  for (const ChannelLoad& other : loads_) {
    if (&other == &load || other.urgent || (robots_ > 0 && other.command)) continue;
    const double most_bits = GoesBefore(other, load) ? other.bits : std::min(other.bits, waiting.entry_bits);
    bits += other.Arrivals(window_s) * most_bits;
  }
  return bits;
}

double DirectionAnalysis::OrdinaryIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const {
  const double frames = FramesBefore(window_s, load, waiting);
  // Either all of them are as long as can be, or everything there is has been sent.
  const double bits =
      BitsBefore(window_s, load, waiting) + std::min(frames * control_bits_, ControlBitsIn(window_s));
  const double everything_s = (bits / 8 + frames * static_cast<double>(frame_bytes_ + 1)) * byte_s_;
  const double before_s = frame_s_ + UrgentIn(window_s, load) + std::min(frames * frame_s_, everything_s);
  return before_s / duty_.rate() + frame_s_ + kTick_s;
}

/// What urgent messages take of the line: their frames and those of the acknowledgements; and the frame that
/// each first one cuts off is sent again.
double DirectionAnalysis::UrgentIn(double window_s, const ChannelLoad& load) const {
  const double cut_s = frame_s_ + byte_s_;
  double s = 0;
  for (const ChannelLoad& other : loads_)
    if (other.urgent && &other != &load) s += other.Arrivals(window_s) * (AllFramesSeconds(other) + cut_s);
  for (const ChannelLoad& incoming : answered_) s += incoming.Arrivals(window_s) * AckFrameSeconds();
  return s;
}

double DirectionAnalysis::Converge(const std::function<double(double window_s)>& latency) const {
  double window_s = 0;
  while (window_s < kNotBounded_s) {
    const double next_s = robots_ > 0 ? latency(window_s) : InTurns(latency(window_s));
    if (next_s <= window_s) return next_s;
    window_s = next_s;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace priamos::bus::radio
