#include "bus/clocks/clock_offset.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus {
namespace {

/// Clocks are read in microseconds, four times in an exchange.
constexpr Duration kResolution{2};

Duration DriftIn(Duration span) {
  return Duration(
      static_cast<Duration::rep>(std::ceil(kMostClockDrift * static_cast<double>(std::abs(span.count())))));
}

}  // namespace

bool ClockOffset::Add(const TwoWayExchange& exchange) {
  const Duration there = exchange.answered - exchange.arrived;
  const Duration in_all = exchange.heard - exchange.sent;
  if (there < Duration::zero() || in_all < Duration::zero() || in_all > kLongest) return false;
  const Duration on_the_way = in_all - there;
  const Duration drift = DriftIn(there);
  if (on_the_way < -drift - kResolution) return false;
  const Duration ahead = ((exchange.arrived - exchange.sent) + (exchange.answered - exchange.heard)) / 2;
  samples_.push_back(
      {exchange.heard, {ahead, std::max(on_the_way, Duration::zero()) / 2 + drift + kResolution}});
  if (samples_.size() > kMostExchanges) samples_.pop_front();
  return true;
}

std::optional<ClockDifference> ClockOffset::At(Time now) const {
  std::optional<ClockDifference> best;
  for (const Sample& sample : samples_) {
    const Duration uncertainty = sample.difference.uncertainty + DriftIn(now - sample.heard);
    if (!best || uncertainty <= best->uncertainty)
      best = ClockDifference{sample.difference.ahead, uncertainty};
  }
  return best;
}

}  // namespace priamos::bus
