#include "bus/radio/budget_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/coded_block.hpp"
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
      datagrams_(options.datagrams),
      packets_(options.packets()),
      ageing_s_(Seconds(options.ageing)),
      frame_bytes_(FrameOverhead(table.code_bytes()) +
                   (options.datagrams ? options.HeadBytes() : kLeadingDelimiter) +
                   (table.HasCommands(direction) ? EchoBytes(options.bytes_per_s) : 0)),
      ahead_s_((options.ahead_bytes + 4) * byte_s_),
      keep_alive_s_(Seconds(options.keep_alive)) {
  const auto bundle_bytes = static_cast<double>(options.max_bundle_bytes);
  double largest = bundle_bytes;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).direction != direction) continue;
    loads_.push_back(LoadOf(i));
    largest = std::max(largest, std::ceil(loads_.back().entry_bits / 8));
  }
  control_bits_ = ControlBits();
  if (options.half_duplex.turn > Duration::zero()) ShareTheAir(options);
  capacity_bits_ = 8 * bundle_bytes - control_bits_;
  frame_s_ = FrameSeconds(8 * largest + control_bits_);
  const double longest_bits = std::min(8 * largest + control_bits_, 8.0 * kMaxBundleBytes);
  const std::size_t beside = frame_bytes_ - (options.datagrams ? options.HeadBytes() : kLeadingDelimiter);
  longest_bytes_ = std::max(
      kHelloFrameBytes, beside + kWholeCounterBytes + static_cast<std::size_t>(std::ceil(longest_bits / 8)));
  overhead_ =
      1 + static_cast<double>(frame_bytes_ - (options.datagrams ? 0 : kLeadingDelimiter)) / bundle_bytes;
}

double DirectionAnalysis::ControlBytesPerSecond() const {
  double bits = kFrameAcks_hz * (table_.id_bits() + kFrameAckBits);
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
  const double bytes = load.repeated ? AllFramesSeconds(load) / byte_s_ : load.bits / 8 * overhead_;
  return bytes * load.keys / load.period_s;
}

ChannelLoad DirectionAnalysis::LoadOf(std::size_t index) const {
  const LinkChannel& c = table_.at(index);
  ChannelLoad load;
  load.channel = index;
  load.urgent = c.urgent;
  load.repeated = c.urgent && c.channel_class == ChannelClass::kEvent;
  load.priority = c.priority;
  load.period_s = c.rate_hz > 0 ? 1 / c.rate_hz : std::numeric_limits<double>::infinity();
  load.burst = c.burst;
  load.keys = c.max_keys;
  SetEntries(c, load);
  return load;
}

void DirectionAnalysis::SetEntries(const LinkChannel& c, ChannelLoad& load) const {
  const double body_bytes = std::ceil(c.max_bits / 8.0);
  const double body_bits = c.fixed_bits > 0 ? c.fixed_bits + (c.delta.empty() ? 0 : 1) : 8 + 8 * body_bytes;
  if (c.channel_class != ChannelClass::kEvent) {
    const int age_bits = c.channel_class == ChannelClass::kCommand ? 6 : 0;
    load.bits = load.entry_bits = table_.id_bits() + age_bits + body_bits;
    return;
  }
  load.entries = std::max(1.0, std::ceil(body_bytes / kSegmentBytes));
  const bool one_segment = c.fixed_bits > 0 && load.entries == 1;
  // Each as if it began a run, and with the bit that ends it.
  const double head_bits = table_.id_bits() + 8 + (one_segment ? 1 : 3) + (c.urgent ? 0 : 1);
  load.bits =
      load.entries == 1 ? head_bits + 12 + body_bits : load.entries * head_bits + 12 + 5 + 8 * body_bytes;
  load.entry_bits = std::min(load.bits, head_bits + 12 + 5 + 8.0 * kSegmentBytes);
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

/// Turns that end a frame early, and the time in between when the other end uses all of its turn.
void DirectionAnalysis::ShareTheAir(const LinkOptions& options) {
  const double longest_s = FrameSeconds(8.0 * static_cast<double>(options.max_bundle_bytes));
  const double alone_s = FrameSeconds(8.0 * static_cast<double>(kMaxBundleBytes)) - longest_s;
  turn_s_ = Seconds(options.half_duplex.turn) - longest_s;
  gap_s_ = Seconds(options.half_duplex.turn) + alone_s +
           2 * (Seconds(options.half_duplex.turnaround) + kHandOver_s);
  control_bits_ += table_.id_bits() + kControlKindBits;  // "over"
}

double DirectionAnalysis::NextSeconds(const ChannelLoad& load) const {
  return InTurns(frame_s_ + FrameSeconds(load.bits) + ahead_s_ + kTick_s);
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
  double urgent_s = 0;
  for (const ChannelLoad& load : loads_)
    if (load.urgent) urgent_s = std::max(urgent_s, FrameSeconds(load.bits));
  return InTurns(ahead_s_ + kTick_s + frame_s_ + urgent_s + AckFrameSeconds());
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

double DirectionAnalysis::Urgent(const ChannelLoad& load) const {
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

double DirectionAnalysis::Ordinary(const ChannelLoad& load) const {
  return Converge([&](double window_s) { return OrdinaryIn(window_s, load); });
}

double DirectionAnalysis::OrdinaryIn(double window_s, const ChannelLoad& load) const {
  double bits = load.bits - load.entry_bits + load.OwnBefore(window_s) * load.bits;
  double entries = load.entries - 1 + load.OwnBefore(window_s) * load.entries;
  double other_bits = 0;  // goes after it, but may fill its frames
  for (const ChannelLoad& other : loads_) {
    if (&other == &load || other.urgent) continue;
    const double arrivals = other.Arrivals(window_s);
    if (!GoesBefore(other, load)) {
      other_bits += arrivals * other.bits;
    } else {
      bits += arrivals * other.bits;
      entries += arrivals * other.entries;
    }
  }
  const double room_bits = capacity_bits_ - load.entry_bits + 1;
  const double frames = room_bits > 0 ? std::min(entries, std::floor(bits / room_bits)) : entries;
  // Either all of them are as long as can be, or everything there is has been sent.
  const double everything_s =
      ((bits + other_bits + frames * control_bits_) / 8 + frames * static_cast<double>(frame_bytes_ + 1)) *
      byte_s_;
  return frame_s_ + UrgentIn(window_s, load) + std::min(frames * frame_s_, everything_s) + frame_s_ + kTick_s;
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
    const double next_s = InTurns(latency(window_s));
    if (next_s <= window_s) return next_s;
    window_s = next_s;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace priamos::bus::radio
