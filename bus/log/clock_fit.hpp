#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace priamos::bus {

/// One message seen on both sides of a link: its time stamp in the clock of the sender, and the same stamp as
/// the receiver restored it in its own clock (time travels as an age).
struct StampPair {
  std::int64_t a_us = 0;  ///< in clock A
  std::int64_t b_us = 0;  ///< in clock B
  bool from_a = true;     ///< A sent it
};

/// Clock A as a line over clock B: a = b + offset + drift * (b - reference).
struct ClockFit {
  double offset_us = 0;  ///< at the reference
  double drift = 0;      ///< microseconds per microsecond
  std::int64_t reference_us = 0;
  std::size_t pairs = 0;     ///< used, without outliers
  std::size_t outliers = 0;  ///< pairs that no clock explains, e.g. two messages that only look alike
  double spread_us = 0;      ///< median distance of the pairs from the line
  double asymmetry_us = 0;   ///< half the difference between the two directions, which the fit averages; 0
                             ///< when only one direction is known
  bool both_ways = false;

  std::int64_t ToA(std::int64_t b_us) const;
};

/// Fits clock A over clock B by the median of slopes and the median of offsets, so that up to a third of
/// wrong pairs do no harm. The drift is only estimated from pairs that span at least 20 s and stays within
/// 0.1 %. nullopt for no pairs.
std::optional<ClockFit> FitClocks(std::vector<StampPair> pairs);

}  // namespace priamos::bus
