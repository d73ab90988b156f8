#pragma once

#include <optional>

#include "common/time.hpp"

namespace priamos {

/// When something that happens at most so often may happen again.
class RateLimit {
 public:
  explicit RateLimit(double rate_hz) : period_s_(1 / rate_hz) {}

  /// Whether a period has passed since the last Mark, or there was none.
  bool Due(Time now) const {
    constexpr double kRounding_s = 1e-6;  // a time counts whole microseconds, a period does not
    return !last_ || Seconds(now - *last_) >= period_s_ - kRounding_s;
  }
  /// It happens now.
  void Mark(Time now) { last_ = now; }

 private:
  double period_s_;
  std::optional<Time> last_;
};

}  // namespace priamos
