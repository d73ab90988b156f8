#include "bus/radio/budget_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace priamos::bus::radio {
namespace {

constexpr double kNotBounded_s = 60;

}  // namespace

DirectionAnalysis::DirectionAnalysis(const ChannelTable& table, const LinkOptions& options,
                                     Direction direction)
    : DirectionFrames(table, options, direction), ageing_s_(Seconds(options.ageing)) {}

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
  const double waiting_bits = waiting.entry_bits + (BesideFresh(load) ? FreshBits() : 0);
  for (const ChannelLoad& other : loads_) {
    if (&other == &load || other.urgent || (robots_ > 0 && other.command) || !GoesBefore(other, load))
      continue;
    if (IsFreshBeside(other, load)) continue;
    const double n = other.Arrivals(window_s);
    ahead.push_back({.entries = n * other.entries, .bits = n * other.bits});
    if (other.newest_only) ahead.back().most_bits = other.keys * other.bits;
  }
  // Either every frame is full of acknowledgements, or they are counted like messages.
  const double reserved = FramesAhead(ahead, capacity_bits_ - waiting_bits + 1);
  if (robots_ > 0 || gap_s_ > 0) return reserved;
  ahead.push_back({.entries = ControlEntriesIn(window_s), .bits = ControlBitsIn(window_s)});
  return std::min(reserved, FramesAhead(ahead, bundle_bits_ - waiting_bits + 1));
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
    if (IsFreshBeside(other, load)) continue;
    const double most_bits = GoesBefore(other, load) ? other.bits : std::min(other.bits, waiting.entry_bits);
    bits += other.Arrivals(window_s) * most_bits;
  }
  return bits;
}

double DirectionAnalysis::OrdinaryIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const {
  const double full = FramesBefore(window_s, load, waiting), cut_short = ShortFrames(window_s, load);
  const double frames = full + cut_short;
  // Either all of them are as long as can be, or everything there is has been sent.
  const double bits = BitsBefore(window_s, load, waiting) +
                      std::min(frames * control_bits_, ControlBitsIn(window_s)) +
                      (BesideFresh(load) ? frames * FreshBits() : 0);
  const double everything_s = (bits / 8 + frames * static_cast<double>(frame_bytes_ + 1)) * byte_s_;
  const double longest_s = full * frame_s_ + cut_short * LongestShortFrameSeconds();
  const double before_s =
      BlockingSeconds(load) + UrgentIn(window_s, load) + std::min(longest_s, everything_s);
  return before_s / duty_.rate() + frame_s_ + kTick_s;
}

/// Frames that are short for the sake of the state whose age is bounded: one before each message that goes
/// alone, this one or one before it, and one after it.
double DirectionAnalysis::ShortFrames(double window_s, const ChannelLoad& load) const {
  if (!BesideFresh(load)) return 0;
  double alone = GoesAlone(load) ? load.keys - 1 : 0;
  for (const ChannelLoad& other : loads_)
    if (&other != &load && GoesAlone(other) && GoesBefore(other, load)) alone += other.Arrivals(window_s);
  return 2 * alone + (GoesAlone(load) ? 1 : 0);
}

/// Time until the first frame that could have this message: of the frame on the line, which may be a short
/// one that promised the next to a message that goes alone. Then a short one follows, and all three keep to
/// the bound of the state.
double DirectionAnalysis::BlockingSeconds(const ChannelLoad& load) const {
  const bool promised = BesideFresh(load) && std::any_of(loads_.begin(), loads_.end(),
                                                         [&](const ChannelLoad& l) { return GoesAlone(l); });
  return promised ? std::max(frame_s_, Seconds(age_bound_.within())) : frame_s_;
}

/// Whether a channel is the one whose age is bounded, and this message another's: it is in every frame.
bool DirectionAnalysis::IsFreshBeside(const ChannelLoad& other, const ChannelLoad& load) const {
  return BesideFresh(load) && other.channel == age_bound_.channel();
}

std::optional<double> DirectionAnalysis::FreshBesideUrgent(double within_s) const {
  for (const ChannelLoad& load : loads_)
    if (age_bound_.enabled() && load.channel == age_bound_.channel()) {
      const double s =
          Converge([&](double window_s) { return within_s + UrgentIn(std::max(window_s, within_s), load); });
      return std::isfinite(s) ? std::optional(s) : std::nullopt;
    }
  return std::nullopt;
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
