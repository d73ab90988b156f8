#include "bus/schema/pack_code.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos::bus {
namespace {

/// Whole but for the rounding of a division.
bool IsNearlyWhole(double value) {
  return std::abs(value) < 0x1p52 && std::abs(value - std::round(value)) <= 1e-12 * std::abs(value);
}

std::uint64_t RoundedQuotient(std::uint64_t dividend, std::uint64_t divisor) {
  const std::uint64_t rest = dividend % divisor;
  return dividend / divisor + (rest >= divisor - rest && rest > 0 ? 1 : 0);
}

}  // namespace

RealCode::RealCode(double min, double max, double step, std::optional<double> invalid)
    : min_(min),
      max_(max),
      step_(step),
      invalid_(invalid),
      last_(static_cast<std::uint64_t>(Steps(min, max, step))) {
  if (IsNearlyWhole(1 / step) && IsNearlyWhole(min / step)) {
    per_unit_ = std::round(1 / step);
    min_per_unit_ = std::round(min / step);
  }
}

double RealCode::Steps(double min, double max, double step) {
  return std::round((max - min) / step);
}

Coded RealCode::Encode(double value) const {
  if (invalid_ && (value == *invalid_ || std::isnan(value))) return {last_ + 1, false};
  const bool lost = std::isnan(value);
  if (lost) value = std::clamp(0.0, min_, max_);
  const double steps = std::clamp(std::round((value - min_) / step_), 0.0, static_cast<double>(last_));
  const auto code = static_cast<std::uint64_t>(steps);
  // The tolerance keeps a rounding error of the division from counting as a loss.
  return {code, lost || std::abs(value - Decode(code)) > step_ * 0.50001};
}

double RealCode::Decode(std::uint64_t code) const {
  if (code > last_) return *invalid_;
  const auto steps = static_cast<double>(code);
  const double value = per_unit_ > 0 ? (min_per_unit_ + steps) / per_unit_ : min_ + steps * step_;
  return std::clamp(value, min_, max_);
}

IntegerCode::IntegerCode(std::int64_t min, std::int64_t max, std::uint64_t step,
                         std::optional<std::int64_t> invalid)
    : min_(min),
      span_(static_cast<std::uint64_t>(max) - static_cast<std::uint64_t>(min)),
      step_(step),
      invalid_(invalid),
      last_(RoundedQuotient(span_, step)) {}

bool IntegerCode::Fits(std::int64_t min, std::int64_t max, std::uint64_t step, bool with_invalid) {
  const std::uint64_t span = static_cast<std::uint64_t>(max) - static_cast<std::uint64_t>(min);
  return !with_invalid || RoundedQuotient(span, step) < std::numeric_limits<std::uint64_t>::max();
}

Coded IntegerCode::Encode(std::int64_t value) const {
  if (invalid_ && value == *invalid_) return {last_ + 1, false};
  if (value < min_)
    return {0, static_cast<std::uint64_t>(min_) - static_cast<std::uint64_t>(value) > step_ / 2};
  const std::uint64_t above = static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(min_);
  if (above > span_) return {last_, above - span_ > step_ / 2};
  return {std::min(RoundedQuotient(above, step_), last_), false};
}

Coded IntegerCode::EncodeUp(std::int64_t value) const {
  const Coded nearest = Encode(value);
  if (Decode(nearest.code) >= value) return nearest;
  return nearest.code < last_ ? Coded{nearest.code + 1, false} : Coded{last_, true};
}

std::int64_t IntegerCode::Decode(std::uint64_t code) const {
  if (code > last_) return *invalid_;
  std::uint64_t above = 0;
  if (__builtin_mul_overflow(code, step_, &above)) above = span_;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(min_) + std::min(above, span_));
}

}  // namespace priamos::bus
