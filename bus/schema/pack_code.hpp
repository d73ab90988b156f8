#pragma once

#include <cstdint>
#include <optional>

namespace priamos::bus {

/// A value as a code, and whether the value was outside the range of codes (beyond half a step).
struct Coded {
  std::uint64_t code = 0;
  bool saturated = false;
};

/// Numbers min, min + step, ... as codes 0, 1, ...: every value within [min, max] comes back with an error of
/// at most half a step; outside it the nearest bound is taken and reported. With `invalid` there is one
/// code more, behind the others, for exactly that value and for NaN; without it NaN becomes the code next
/// to zero and is reported. Decoded values never leave [min, max]; where step is the inverse of a whole
/// number they are the doubles a person would write (0.3, not 0.30000000000000004).
class RealCode {
 public:
  /// Code for values in [min, max], in units of the field. Needs min < max, step > 0 and at most 2^52 steps.
  RealCode(double min, double max, double step, std::optional<double> invalid);

  Coded Encode(double value) const;
  double Decode(std::uint64_t code) const;
  /// Largest code that stands for a value.
  std::uint64_t last() const { return last_ + (invalid_ ? 1 : 0); }

  /// Steps between the bounds, rounded; not finite or above 2^52 when there are too many for a code.
  static double Steps(double min, double max, double step);

 private:
  double min_;
  double max_;
  double step_;
  std::optional<double> invalid_;
  std::uint64_t last_;
  double per_unit_ = 0;      // 1 / step when both it and min * per_unit are whole numbers, else 0
  double min_per_unit_ = 0;  // min * per_unit
};

/// Integers min, min + step, ... as codes 0, 1, ...: RealCode for whole numbers, exact over all of int64_t
/// when step is 1.
class IntegerCode {
 public:
  /// Code for values in [min, max]. Needs min < max and step > 0.
  IntegerCode(std::int64_t min, std::int64_t max, std::uint64_t step, std::optional<std::int64_t> invalid);

  Coded Encode(std::int64_t value) const;
  /// The first code that stands for no less than the value: an age that is never too small.
  Coded EncodeUp(std::int64_t value) const;
  std::int64_t Decode(std::uint64_t code) const;
  /// Largest code that stands for a value.
  std::uint64_t last() const { return last_ + (invalid_ ? 1 : 0); }

  /// Whether all codes, `with_invalid` one more for the invalid value, fit into 64 bits.
  static bool Fits(std::int64_t min, std::int64_t max, std::uint64_t step, bool with_invalid);

 private:
  std::int64_t min_;
  std::uint64_t span_;
  std::uint64_t step_;
  std::optional<std::int64_t> invalid_;
  std::uint64_t last_;
};

}  // namespace priamos::bus
