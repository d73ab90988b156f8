#include "bus/radio/budget_frames.hpp"

#include <algorithm>
#include <cmath>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/coded_block.hpp"
#include "bus/radio/frame_length.hpp"
#include "bus/radio/line/repetition.hpp"

namespace priamos::bus::radio {
namespace {

/// Bytes of a frame beside its bundle, with the delimiter that leads after silence.
constexpr std::size_t kLeadingDelimiter = 1;
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

DirectionFrames::DirectionFrames(const ChannelTable& table, const LinkOptions& options, Direction direction)
    : direction_(direction),
      age_bound_(table, direction),
      byte_s_(1 / options.bytes_per_s),
      duty_(options.duty),
      packets_(options.packets()),
      frame_bytes_(
          FrameOverhead(table.code_bytes()) + (options.datagrams ? options.HeadBytes() : kLeadingDelimiter) +
          (table.HasCommands(direction) ? EchoBytes(options.bytes_per_s) : 0) + (options.robots > 0 ? 1 : 0)),
      ahead_s_((options.ahead_bytes + 4) * byte_s_),
      table_(table),
      datagrams_(options.datagrams),
      keep_alive_s_(Seconds(options.keep_alive)) {
  const FrameLength length = FrameLengthOf(table, options, direction);
  const auto bundle_bytes = static_cast<double>(length.bundle_bytes);
  double largest = bundle_bytes;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).direction != direction) continue;
    loads_.push_back(LoadOf(table_, i));
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

bool DirectionFrames::BesideFresh(const ChannelLoad& load) const {
  return age_bound_.enabled() && load.channel != age_bound_.channel();
}

double DirectionFrames::LongestShortFrameSeconds() const {
  const double least_s = FrameSeconds(FreshBits());
  return std::max(least_s, Seconds(age_bound_.within()) - least_s - FrameSeconds(bundle_bits_));
}

double DirectionFrames::LeastFreshSeconds() const {
  double s = 2 * FrameSeconds(bundle_bits_);
  for (const ChannelLoad& load : loads_)
    if (GoesAlone(load))
      s = std::max(s, FrameSeconds(load.bits) + 2 * FrameSeconds(FreshBits()) +
                          static_cast<double>(kLeadingDelimiter + kHelloFrameBytes) * byte_s_);
  return s + Seconds(AgeBound::kMargin);
}

double DirectionFrames::ControlBytesPerSecond() const {
  const double acks_hz = robots_ > 0 ? std::min(kFrameAcks_hz, 1 / Seconds(polled_.cycle)) : kFrameAcks_hz;
  double bits = acks_hz * (table_.id_bits() + kFrameAckBits);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.direction == direction_ || c.channel_class != ChannelClass::kEvent || c.urgent) continue;
    const ChannelLoad incoming = LoadOf(table_, i);
    // One per frame that brings some of the event.
    const double frames = std::ceil(incoming.bits / capacity_bits_);
    bits += frames / incoming.period_s * (2 * table_.id_bits() + kEventAckBits);
  }
  double bytes = bits / 8 * overhead_;
  for (const ChannelLoad& incoming : answered_) bytes += AckFrameSeconds() / byte_s_ / incoming.period_s;
  return bytes;
}

double DirectionFrames::BytesPerSecond(const ChannelLoad& load) const {
  if (robots_ > 0 && load.command) return 0;  // the newest, in frames that a robot gets beside its share
  if (robots_ > 0) return load.bits / 8 * overhead_ * load.keys / load.period_s;
  const double bytes = load.repeated ? AllFramesSeconds(load) / byte_s_ : load.bits / 8 * overhead_;
  return bytes * load.keys / load.period_s;
}

/// Acknowledgements that can be in one frame before the messages.
double DirectionFrames::ControlBits() const {
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
double DirectionFrames::ControlEntriesIn(double window_s) const {
  double entries = 2 + std::floor(window_s * kFrameAcks_hz) + std::floor(window_s * kAnnouncements_hz);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.direction == direction_ || c.channel_class != ChannelClass::kEvent) continue;
    const ChannelLoad incoming = LoadOf(table_, i);
    entries += incoming.Arrivals(window_s) * incoming.entries;
  }
  return entries;
}

/// Bits of these.
double DirectionFrames::ControlBitsIn(double window_s) const {
  double bits = (1 + std::floor(window_s * kFrameAcks_hz)) * (table_.id_bits() + kFrameAckBits);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const LinkChannel& c = table_.at(i);
    if (c.direction == direction_ || c.channel_class != ChannelClass::kEvent) continue;
    const ChannelLoad incoming = LoadOf(table_, i);
    bits += incoming.Arrivals(window_s) * incoming.entries * (2 * table_.id_bits() + kEventAckBits);
  }
  const double announcement_bits = table_.id_bits() + kControlKindBits + static_cast<double>(table_.size());
  return bits + (1 + std::floor(window_s * kAnnouncements_hz)) * announcement_bits;
}

/// Turns that end a frame early, and the time in between when the other end uses all of its turn.
void DirectionFrames::ShareTheAir(const LinkOptions& options) {
  const double longest_s = FrameSeconds(8.0 * static_cast<double>(options.max_bundle_bytes));
  const double alone_s = FrameSeconds(8.0 * static_cast<double>(kMaxBundleBytes)) - longest_s;
  turn_s_ = Seconds(options.half_duplex.turn) - longest_s;
  gap_s_ = Seconds(options.half_duplex.turn) + alone_s +
           2 * (Seconds(options.half_duplex.turnaround) + kHandOver_s);
  control_bits_ += table_.id_bits() + kControlKindBits;  // "over"
}

/// "Over", and the bit that ends a run of segments before it.
double DirectionFrames::OverBits() const {
  return table_.id_bits() + kControlKindBits + 1;
}

/// No message makes such a frame longer, and acknowledgements leave room for one.
void DirectionFrames::ConfineTo(double bundle_bytes, double& largest_bytes) {
  const double bits = 8 * bundle_bytes;
  control_bits_ = std::min(control_bits_, std::max(0.0, bits - largest_bits_));
  largest_bytes = (bits - control_bits_) / 8;
}

void DirectionFrames::SetPolled(const PollBounds& bounds, int robots) {
  polled_ = bounds;
  robots_ = robots;
  turn_s_ = Seconds(LongestFrameTime());
  gap_s_ = Seconds(bounds.cycle) - turn_s_;
}

std::size_t DirectionFrames::SmallestBundleBytes() const {
  const double ack_bits = std::max(table_.id_bits() + kFrameAckBits, 2 * table_.id_bits() + kEventAckBits);
  return static_cast<std::size_t>(std::ceil((largest_bits_ + ack_bits + OverBits()) / 8));
}

Duration DirectionFrames::LongestFrameTime() const {
  return FromSeconds(static_cast<double>(longest_bytes_ + kLeadingDelimiter) * byte_s_);
}

double DirectionFrames::UrgentFrameSeconds() const {
  double longest_s = 0;
  for (const ChannelLoad& load : loads_)
    if (load.urgent) longest_s = std::max(longest_s, FrameSeconds(load.bits));
  return longest_s;
}

double DirectionFrames::SilenceSeconds() const {
  if (robots_ > 0) return Seconds(polled_.asked) + frame_s_;
  return std::max({keep_alive_s_, gap_s_, duty_.limited() ? frame_s_ / duty_.rate() : 0}) + frame_s_;
}

double DirectionFrames::LongestSilenceSeconds() const {
  return robots_ > 0 ? Seconds(polled_.cycle) + frame_s_ : SilenceSeconds() + kTick_s;
}

double DirectionFrames::CreditSeconds() const {
  double s = frame_s_;
  for (const ChannelLoad& load : loads_)
    if (load.urgent) s += load.Arrivals(0) * AllFramesSeconds(load);
  for (const ChannelLoad& incoming : answered_) s += incoming.Arrivals(0) * AckFrameSeconds();
  return s;
}

double DirectionFrames::NextSeconds(const ChannelLoad& load) const {
  if (robots_ > 0) return Seconds(polled_.asked) + FrameSeconds(load.bits) + kTick_s;
  return InTurns(frame_s_ / duty_.rate() + FrameSeconds(load.bits) + ahead_s_ + kTick_s);
}

double DirectionFrames::AheadSeconds() const {
  return ahead_s_ + kTick_s + (packets_ ? frame_s_ : 0);
}

/// When work that takes `work_s` on the line is done.
double DirectionFrames::InTurns(double work_s) const {
  return gap_s_ > 0 ? work_s + gap_s_ * (1 + std::floor(work_s / turn_s_)) : work_s;
}

double DirectionFrames::FrameSeconds(double bits) const {
  return (static_cast<double>(frame_bytes_) + std::ceil(bits / 8)) * byte_s_;
}

/// A frame that only acknowledges urgent events.
double DirectionFrames::AckFrameSeconds() const {
  double bits = 0;
  for (const LinkChannel& c : table_.channels())
    if (c.direction != direction_ && c.urgent && c.channel_class == ChannelClass::kEvent)
      bits += 2 * table_.id_bits() + kEventAckBits;
  return FrameSeconds(bits);
}

double DirectionFrames::AnswerSeconds() const {
  return InTurns(ahead_s_ + kTick_s + frame_s_ + UrgentFrameSeconds() + AckFrameSeconds());
}

/// A repetition of an urgent event: a block that corrects errors, where it fits one.
double DirectionFrames::RepeatedFrameSeconds(double bits) const {
  // Two bytes beside the content: COBS's code byte and the delimiter.
  const std::size_t content =
      frame_bytes_ - kLeadingDelimiter - 2 + static_cast<std::size_t>(std::ceil(bits / 8));
  const std::size_t block = datagrams_ ? 0 : BlockBytes(content);
  if (block == 0) return FrameSeconds(bits);
  return static_cast<double>(EncodedBlockBytes(block) + 1 + kLeadingDelimiter) * byte_s_;
}

/// All frames with the same urgent event: the first, repetitions until it is acknowledged, and the one that
/// is on the line then. After kRepeatAtOnce they take half of the line.
double DirectionFrames::AllFramesSeconds(const ChannelLoad& load) const {
  if (!load.repeated) return FrameSeconds(load.bits);
  constexpr double at_once_s = 1e-6 * static_cast<double>(kRepeatAtOnce.count());
  const double busy_s = std::min(repeat_s_, at_once_s) + std::max(0.0, repeat_s_ - at_once_s) / 2;
  const double repeated_s = RepeatedFrameSeconds(load.bits);
  return FrameSeconds(load.bits) + (1 + std::floor(busy_s / repeated_s)) * repeated_s;
}

}  // namespace priamos::bus::radio
