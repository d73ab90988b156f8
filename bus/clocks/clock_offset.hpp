#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "common/time.hpp"

namespace priamos::bus {

/// A message that went to another clock and its answer, as in NTP (RFC 5905, section 8).
struct TwoWayExchange {
  Time sent;      ///< by our clock
  Time arrived;   ///< there, by the other clock
  Time answered;  ///< from there, by the other clock
  Time heard;     ///< by our clock
};

/// How far another clock is ahead of ours.
struct ClockDifference {
  Duration ahead{};
  Duration uncertainty{};  ///< the truth is no further away
};

/// Largest difference in rate between two clocks that is counted with: 100 parts in a million each.
inline constexpr double kMostClockDrift = 2e-4;

/// Estimates how far one other clock is ahead of ours from exchanges with it. The exchange that took least
/// time is the most exact: half of its time is what its two ways may differ by. Older ones count less by what
/// the clocks may have drifted since. Where NTP slews a clock, by up to 8 % of the time, exchanges contradict
/// each other: then the older ones are forgotten, and the rate that they show is counted with until it is
/// over. Pure.
class ClockOffset {
 public:
  /// Exchanges that are remembered; the oldest is forgotten.
  static constexpr std::size_t kMostExchanges = 32;
  /// An exchange that took longer says nothing.
  static constexpr Duration kLongest{2'000'000};

  /// Takes an exchange; returns false for one that cannot have been (a negative time on the way), or that
  /// took too long.
  bool Add(const TwoWayExchange& exchange);

  /// The difference at `now`, by our clock; nullopt before the first exchange.
  std::optional<ClockDifference> At(Time now) const;
  /// Whether one of the clocks runs faster or slower than clocks do: it is being slewed.
  bool unsteady() const { return drift_ > kMostClockDrift; }

 private:
  struct Sample {
    Time heard;
    ClockDifference difference;
  };
  Duration DriftIn(Duration span) const;
  void ForgetWhatContradicts(const Sample& newest);

  std::deque<Sample> samples_;
  double drift_ = kMostClockDrift;  ///< that is counted with now
};

}  // namespace priamos::bus
