#include "bus/clocks/clock_offset.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus {
namespace {

/// Clocks are read in microseconds, four times in an exchange.
constexpr Duration kResolution{2};

/// Twice the rate at which chrony slews a clock at most.
constexpr double kMostSlew = 0.17;

}  // namespace

Duration ClockOffset::DriftIn(Duration span) const {
  return Duration(
      static_cast<Duration::rep>(std::ceil(drift_ * static_cast<double>(std::abs(span.count())))));
}

void ClockOffset::ForgetWhatContradicts(const Sample& newest) {
  const auto contradicts = [&](const Sample& sample) {
    const Duration apart = std::chrono::abs(newest.difference.ahead - sample.difference.ahead);
    return apart > newest.difference.uncertainty + sample.difference.uncertainty +
                       DriftIn(newest.heard - sample.heard);
  };
  drift_ = std::max(kMostClockDrift, drift_ / 2);
  if (samples_.empty() || std::none_of(samples_.begin(), samples_.end(), contradicts)) return;
  const Sample& last = samples_.back();
  const double apart_s = Seconds(std::chrono::abs(newest.difference.ahead - last.difference.ahead));
  const double span_s = std::max(Seconds(newest.heard - last.heard), 1e-3);
  drift_ = std::clamp(2 * apart_s / span_s, drift_, kMostSlew);
  std::erase_if(samples_, contradicts);
}

bool ClockOffset::Add(const TwoWayExchange& exchange) {
  const Duration there = exchange.answered - exchange.arrived;
  const Duration in_all = exchange.heard - exchange.sent;
  if (there < Duration::zero() || in_all < Duration::zero() || in_all > kLongest) return false;
  const Duration on_the_way = in_all - there;
  const Duration drift = DriftIn(there);
  if (on_the_way < -drift - kResolution) return false;
  const Duration ahead = ((exchange.arrived - exchange.sent) + (exchange.answered - exchange.heard)) / 2;
  const Sample sample{exchange.heard,
                      {ahead, std::max(on_the_way, Duration::zero()) / 2 + drift + kResolution}};
  ForgetWhatContradicts(sample);
  samples_.push_back(sample);
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
