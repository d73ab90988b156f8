#include "bus/log/clock_fit.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus {
namespace {

constexpr double kShortestSpan_us = 20e6;
constexpr double kLargestDrift = 1e-3;
constexpr std::size_t kMostForSlopes = 300;

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double Difference(const StampPair& pair) {
  return static_cast<double>(pair.a_us - pair.b_us);
}

/// Median of the slopes between pairs that are at least half the span apart (Theil and Sen).
double SlopeOf(const std::vector<StampPair>& pairs) {
  const double span = static_cast<double>(pairs.back().b_us - pairs.front().b_us);
  if (span < kShortestSpan_us) return 0;
  const std::size_t stride = pairs.size() / kMostForSlopes + 1;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < pairs.size(); i += stride) {
    for (std::size_t k = i + stride; k < pairs.size(); k += stride) {
      const double apart = static_cast<double>(pairs[k].b_us - pairs[i].b_us);
      if (apart >= span / 2) slopes.push_back((Difference(pairs[k]) - Difference(pairs[i])) / apart);
    }
  }
  return std::clamp(Median(slopes), -kLargestDrift, kLargestDrift);
}

double Residual(const ClockFit& fit, const StampPair& pair) {
  return Difference(pair) - fit.drift * static_cast<double>(pair.b_us - fit.reference_us);
}

std::vector<double> Residuals(const ClockFit& fit, const std::vector<StampPair>& pairs,
                              std::optional<bool> from_a) {
  std::vector<double> all;
  for (const auto& pair : pairs)
    if (!from_a || pair.from_a == *from_a) all.push_back(Residual(fit, pair));
  return all;
}

double MedianDistance(std::vector<double> values, double from) {
  for (double& value : values) value = std::abs(value - from);
  return Median(std::move(values));
}

/// What the receiver adds to an age in error has opposite signs in the two directions: their mean is free of
/// what they have in common.
void BalanceDirections(ClockFit& fit, const std::vector<StampPair>& pairs) {
  const auto up = Residuals(fit, pairs, true), down = Residuals(fit, pairs, false);
  fit.both_ways = up.size() >= 3 && down.size() >= 3;
  if (!fit.both_ways) return;
  fit.offset_us = (Median(up) + Median(down)) / 2;
  fit.asymmetry_us = (Median(up) - Median(down)) / 2;
}

}  // namespace

std::int64_t ClockFit::ToA(std::int64_t b_us) const {
  return b_us + std::llround(offset_us + drift * static_cast<double>(b_us - reference_us));
}

std::optional<ClockFit> FitClocks(std::vector<StampPair> pairs) {
  if (pairs.empty()) return std::nullopt;
  std::sort(pairs.begin(), pairs.end(),
            [](const StampPair& x, const StampPair& y) { return x.b_us < y.b_us; });
  ClockFit fit;
  fit.reference_us = pairs.front().b_us;
  fit.drift = SlopeOf(pairs);
  fit.offset_us = Median(Residuals(fit, pairs, std::nullopt));
  const double spread = MedianDistance(Residuals(fit, pairs, std::nullopt), fit.offset_us);
  const double limit = std::max(6 * spread, 50e3);  // stamps travel in steps of up to 0.1 s
  const std::size_t all = pairs.size();
  std::erase_if(pairs,
                [&](const StampPair& pair) { return std::abs(Residual(fit, pair) - fit.offset_us) > limit; });
  fit.pairs = pairs.size();
  fit.outliers = all - pairs.size();
  fit.spread_us = MedianDistance(Residuals(fit, pairs, std::nullopt), fit.offset_us);
  BalanceDirections(fit, pairs);
  return fit;
}

}  // namespace priamos::bus
