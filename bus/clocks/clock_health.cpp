#include "bus/clocks/clock_health.hpp"

#include <algorithm>

namespace priamos::bus {
namespace {

constexpr double kFurthest_s = 100'000;       // of health_t.clock_ahead_s
constexpr double kMostUncertain_s = 1;        // of health_t.clock_uncertainty_s
constexpr double kUnknownUncertainty_s = -1;  // of the same

}  // namespace

void SetClock(health_t& message, const std::optional<ClockDifference>& ahead) {
  const bool known = ahead && Seconds(ahead->uncertainty) <= kMostUncertain_s;
  message.clock_ahead_s = known ? std::clamp(Seconds(ahead->ahead), -kFurthest_s, kFurthest_s) : 0;
  message.clock_uncertainty_s = known ? Seconds(ahead->uncertainty) : kUnknownUncertainty_s;
}

}  // namespace priamos::bus
