#include "bus/radio/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bus/radio/event_stream.hpp"
#include "common/config.hpp"

namespace priamos::bus::radio {
namespace {

/// Bytes of a frame beside its bundle, with the delimiter that leads after silence.
constexpr std::size_t kLeadingDelimiter = 1;
constexpr double kNotBounded_s = 60;
/// Bytes are handed to the line once per tick.
constexpr double kTick_s = 0.001;
/// Half-duplex: between the end of one end's turn and what the other one makes of it.
constexpr double kHandOver_s = 2 * kTick_s;
/// Acknowledgements of frames per second, at most.
constexpr double kFrameAcks_hz = 4;
constexpr int kFrameAckBits = 3 + 12 + 12 + 4;
constexpr int kEventAckBits = 3 + 8 + 6 + 1 + static_cast<int>(kAckWindow);

/// One channel as a load on its direction.
struct Load {
  std::size_t channel = 0;
  bool urgent = false;
  int priority = 0;
  double period_s = 0;
  double burst = 1;
  double keys = 1;
  double entries = 1;     ///< per message
  double entry_bits = 0;  ///< largest of them
  double bits = 0;        ///< all of them
  double latency_s = std::numeric_limits<double>::infinity();

  /// Messages that can come in a window of this length.
  double Arrivals(double window_s) const { return keys * (burst + std::floor(window_s / period_s)); }
};

class DirectionAnalysis {
 public:
  DirectionAnalysis(const ChannelTable& table, const LinkOptions& options, Direction direction)
      : table_(table), byte_s_(1 / options.bytes_per_s), ageing_s_(Seconds(options.ageing)) {
    frame_bytes_ = kFrameOverhead + (options.datagrams ? kDatagramHead : kLeadingDelimiter);
    ahead_s_ = (options.ahead_bytes + 4) * byte_s_;
    std::size_t largest = options.max_bundle_bytes;
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (table.at(i).direction != direction) continue;
      loads_.push_back(LoadOf(i));
      largest = std::max(largest, static_cast<std::size_t>(std::ceil(loads_.back().entry_bits / 8)));
    }
    control_bits_ = ControlBits(direction);
    if (options.half_duplex.turn > Duration::zero()) ShareTheAir(options);
    capacity_bits_ = 8.0 * static_cast<double>(options.max_bundle_bytes) - control_bits_;
    frame_s_ = FrameSeconds(8.0 * static_cast<double>(largest) + control_bits_);
    overhead_ = 1 + static_cast<double>(frame_bytes_ - (options.datagrams ? 0 : kLeadingDelimiter)) /
                        static_cast<double>(options.max_bundle_bytes);
    Solve();
  }

  const std::vector<Load>& loads() const { return loads_; }
  /// Of the line, what this direction has for sure.
  double share() const { return turn_s_ / (turn_s_ + gap_s_); }
  /// Bytes of a frame per byte of its bundle.
  double overhead() const { return overhead_; }
  double ControlBytesPerSecond(Direction direction) const {
    double bits = kFrameAcks_hz * (table_.id_bits() + kFrameAckBits);
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const LinkChannel& c = table_.at(i);
      if (c.direction == direction || c.channel_class != ChannelClass::kEvent) continue;
      const Load incoming = LoadOf(i);
      // One per frame that brings some of the event.
      const double frames = std::ceil(incoming.bits / capacity_bits_);
      bits += frames / incoming.period_s * (2 * table_.id_bits() + kEventAckBits);
    }
    return bits / 8 * overhead_;
  }

 private:
  Load LoadOf(std::size_t index) const {
    const LinkChannel& c = table_.at(index);
    Load load;
    load.channel = index;
    load.urgent = c.urgent;
    load.priority = c.priority;
    load.period_s = c.rate_hz > 0 ? 1 / c.rate_hz : std::numeric_limits<double>::infinity();
    load.burst = c.burst;
    load.keys = c.max_keys;
    const double body_bytes = std::ceil(c.max_bits / 8.0);
    const double body_bits = c.fixed_bits > 0 ? c.fixed_bits : 8 + 8 * body_bytes;
    switch (c.channel_class) {
      case ChannelClass::kState:
        load.bits = load.entry_bits = table_.id_bits() + body_bits;
        break;
      case ChannelClass::kCommand:
        load.bits = load.entry_bits = table_.id_bits() + 6 + body_bits;
        break;
      case ChannelClass::kEvent: {
        load.entries = std::max(1.0, std::ceil(body_bytes / kSegmentBytes));
        const double head_bits = table_.id_bits() + 8 + 3;
        load.bits = load.entries == 1 ? head_bits + 12 + body_bits
                                      : load.entries * head_bits + 12 + 5 + 8 * body_bytes;
        load.entry_bits = std::min(load.bits, head_bits + 12 + 5 + 8.0 * kSegmentBytes);
        break;
      }
    }
    return load;
  }

  /// Acknowledgements that can be in one frame before the messages.
  double ControlBits(Direction direction) const {
    double bits = table_.id_bits() + kFrameAckBits;
    bool on_request = false;
    for (const LinkChannel& c : table_.channels()) {
      if (c.direction == direction) continue;
      if (c.channel_class == ChannelClass::kEvent) bits += 2 * table_.id_bits() + kEventAckBits;
      on_request = on_request || c.on_request;
    }
    if (on_request) bits += table_.id_bits() + 3 + static_cast<double>(table_.size());
    return bits;
  }

  /// Turns that end a frame early, and the time in between when the other end uses all of its turn.
  void ShareTheAir(const LinkOptions& options) {
    const double longest_s = FrameSeconds(8.0 * static_cast<double>(options.max_bundle_bytes));
    const double alone_s = FrameSeconds(8.0 * static_cast<double>(kMaxBundleBytes)) - longest_s;
    turn_s_ = Seconds(options.half_duplex.turn) - longest_s;
    gap_s_ = Seconds(options.half_duplex.turn) + alone_s +
             2 * (Seconds(options.half_duplex.turnaround) + kHandOver_s);
    control_bits_ += table_.id_bits() + 3;  // "over"
  }
  /// When work that takes `work_s` on the line is done.
  double InTurns(double work_s) const {
    return gap_s_ > 0 ? work_s + gap_s_ * (1 + std::floor(work_s / turn_s_)) : work_s;
  }

  double FrameSeconds(double bits) const {
    return (static_cast<double>(frame_bytes_) + std::ceil(bits / 8)) * byte_s_;
  }

  void Solve() {
    // Latencies only grow when more overtake, so this ends.
    for (bool changed = true; changed;) {
      std::vector<double> latencies;
      for (const Load& load : loads_) latencies.push_back(load.urgent ? Urgent(load) : Ordinary(load));
      changed = false;
      for (std::size_t i = 0; i < loads_.size(); ++i) {
        changed = changed || loads_[i].latency_s != latencies[i];
        loads_[i].latency_s = latencies[i];
      }
      solved_once_ = true;
    }
  }

  bool GoesBefore(const Load& other, const Load& load) const {
    if (other.priority <= load.priority) return true;
    // Before the first solution nobody is late; later, who waits longer than the levels between overtakes.
    return solved_once_ && other.latency_s >= (other.priority - load.priority) * ageing_s_;
  }

  double Urgent(const Load& load) const {
    double blocking_s = 0;
    for (const Load& other : loads_)
      if (other.urgent && &other != &load) blocking_s = std::max(blocking_s, FrameSeconds(other.bits));
    return Converge([&](double window_s) {
      double s = ahead_s_ + kTick_s + blocking_s + FrameSeconds(load.bits) * OwnBefore(load, window_s);
      for (const Load& other : loads_)
        if (other.urgent && &other != &load && other.priority <= load.priority)
          s += other.Arrivals(window_s) * FrameSeconds(other.bits);
      return s + FrameSeconds(load.bits);
    });
  }

  /// Messages of the same channel that were there before.
  static double OwnBefore(const Load& load, double window_s) {
    return load.entries > 1 || load.burst > 1 || load.keys > 1 ? load.Arrivals(window_s) - 1
                                                               : std::floor(window_s / load.period_s);
  }

  double Ordinary(const Load& load) const {
    return Converge([&](double window_s) {
      double bits = load.bits - load.entry_bits + OwnBefore(load, window_s) * load.bits;
      double entries = load.entries - 1 + OwnBefore(load, window_s) * load.entries;
      double other_bits = 0;  // goes after it, but may fill its frames
      double urgent_s = 0;
      for (const Load& other : loads_) {
        if (&other == &load) continue;
        const double arrivals = other.Arrivals(window_s);
        // An urgent message takes its own frame, and the frame it cuts off is sent again.
        if (other.urgent) urgent_s += arrivals * (FrameSeconds(other.bits) + frame_s_ + byte_s_);
        if (other.urgent) continue;
        if (!GoesBefore(other, load)) {
          other_bits += arrivals * other.bits;
          continue;
        }
        bits += arrivals * other.bits;
        entries += arrivals * other.entries;
      }
      const double room_bits = capacity_bits_ - load.entry_bits + 1;
      const double frames = room_bits > 0 ? std::min(entries, std::floor(bits / room_bits)) : entries;
      // Either all of them are as long as can be, or everything there is has been sent.
      const double everything_s = ((bits + other_bits + frames * control_bits_) / 8 +
                                   frames * static_cast<double>(frame_bytes_ + 1)) *
                                  byte_s_;
      return frame_s_ + urgent_s + std::min(frames * frame_s_, everything_s) + frame_s_ + kTick_s;
    });
  }

  template <class Latency>
  double Converge(const Latency& latency) const {
    double window_s = 0;
    while (window_s < kNotBounded_s) {
      const double next_s = InTurns(latency(window_s));
      if (next_s <= window_s) return next_s;
      window_s = next_s;
    }
    return std::numeric_limits<double>::infinity();
  }

  const ChannelTable& table_;
  double byte_s_;
  double ageing_s_;
  std::size_t frame_bytes_ = 0;  ///< beside the bundle
  double ahead_s_ = 0;
  double control_bits_ = 0;
  double capacity_bits_ = 0;
  double frame_s_ = 0;
  double turn_s_ = 1;  ///< with gap_s_ = 0: no turns
  double gap_s_ = 0;
  double overhead_ = 1;
  bool solved_once_ = false;
  std::vector<Load> loads_;
};

DirectionBudget Analyse(const ChannelTable& table, const LinkOptions& options, Direction direction) {
  const DirectionAnalysis analysis(table, options, direction);
  DirectionBudget budget;
  budget.direction = direction;
  budget.control_bytes_per_s = analysis.ControlBytesPerSecond(direction);
  budget.bytes_per_s = budget.control_bytes_per_s;
  budget.capacity_bytes_per_s = options.bytes_per_s * analysis.share();
  for (const Load& load : analysis.loads()) {
    ChannelBudget row;
    row.channel = load.channel;
    row.bits = static_cast<std::size_t>(load.bits);
    row.rate_hz = load.keys / load.period_s;
    row.bytes_per_s = load.bits / 8 * analysis.overhead() * row.rate_hz;
    row.share = row.bytes_per_s / budget.capacity_bytes_per_s;
    if (std::isfinite(load.latency_s)) row.worst_latency = FromSeconds(load.latency_s);
    budget.bytes_per_s += row.bytes_per_s;
    budget.channels.push_back(row);
  }
  budget.utilisation = budget.bytes_per_s / budget.capacity_bytes_per_s;
  return budget;
}

const char* NameOf(Direction d) {
  return d == Direction::kUp ? "up" : "down";
}

void CheckDirection(const ChannelTable& table, const DirectionBudget& budget,
                    std::vector<std::string>& problems) {
  if (budget.utilisation > 1) {
    ChannelBudget largest;
    for (const ChannelBudget& row : budget.channels)
      if (row.share > largest.share) largest = row;
    problems.push_back(
        fmt::format("radio link {}: expected at most {:.0f} byte/s, got {:.0f} byte/s: lower a rate_hz, {} "
                    "alone takes {:.0f} byte/s",
                    NameOf(budget.direction), budget.capacity_bytes_per_s, budget.bytes_per_s,
                    largest.share > 0 ? table.at(largest.channel).name : "acknowledging",
                    largest.share > 0 ? largest.bytes_per_s : budget.control_bytes_per_s));
  }
  for (const ChannelBudget& row : budget.channels) {
    const LinkChannel& c = table.at(row.channel);
    if (c.deadline <= Duration::zero() || (row.worst_latency && *row.worst_latency <= c.deadline)) continue;
    problems.push_back(fmt::format(
        "radio channel {}: expected delivery within its deadline_s of {:.3f} s, got {} in the worst case: "
        "give it a "
        "smaller priority number, lower the rate_hz of others, or lower max_bundle_bytes",
        c.name, Seconds(c.deadline),
        row.worst_latency ? fmt::format("{:.3f} s", Seconds(*row.worst_latency)) : "no bound at all"));
  }
}

std::string FormatRow(const ChannelTable& table, const ChannelBudget& row) {
  constexpr const char* kClasses[] = {"state", "event", "command"};
  const LinkChannel& c = table.at(row.channel);
  const auto seconds = [](Duration d) { return fmt::format("{:.3f}", Seconds(d)); };
  const std::string worst = row.worst_latency ? seconds(*row.worst_latency) : "none";
  const bool has_deadline = c.deadline > Duration::zero();
  const std::string slack =
      has_deadline && row.worst_latency ? seconds(c.deadline - *row.worst_latency) : "-";
  return fmt::format("  {:<24} {:<8} {:>2}{} {:>6} {:>7.2f} {:>8.1f} {:>6.1f} % {:>8} {:>8} {:>8}\n", c.name,
                     kClasses[static_cast<int>(c.channel_class)], c.priority, c.urgent ? "!" : " ", row.bits,
                     row.rate_hz, row.bytes_per_s, 100 * row.share, worst,
                     has_deadline ? seconds(c.deadline) : "-", slack);
}

}  // namespace

Budget ComputeBudget(const ChannelTable& table, const LinkOptions& options) {
  Budget budget{Analyse(table, options, Direction::kUp), Analyse(table, options, Direction::kDown), {}};
  CheckDirection(table, budget.up, budget.problems);
  CheckDirection(table, budget.down, budget.problems);
  return budget;
}

void RequireBudget(const ChannelTable& table, const LinkOptions& options) {
  const Budget budget = ComputeBudget(table, options);
  if (!budget.problems.empty()) throw ConfigError(budget.problems.front());
}

std::string FormatBudget(const ChannelTable& table, const Budget& budget) {
  std::string text;
  for (const DirectionBudget* d : {&budget.up, &budget.down}) {
    text += fmt::format("{} ({}): {:.0f} of {:.0f} byte/s, {:.0f} % of the line\n", NameOf(d->direction),
                        d->direction == Direction::kUp ? "robot to workstation" : "workstation to robot",
                        d->bytes_per_s, d->capacity_bytes_per_s, 100 * d->utilisation);
    text += fmt::format("  {:<24} {:<8} {:>3} {:>6} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "channel",
                        "class", "pri", "bits", "1/s", "byte/s", "share", "worst s", "deadline", "slack");
    for (const ChannelBudget& row : d->channels) text += FormatRow(table, row);
    text += fmt::format("  {:<24} {:>36.1f} {:>6.1f} %\n", "acknowledgements", d->control_bytes_per_s,
                        100 * d->control_bytes_per_s / d->capacity_bytes_per_s);
  }
  for (const std::string& problem : budget.problems) text += problem + "\n";
  return text;
}

}  // namespace priamos::bus::radio
