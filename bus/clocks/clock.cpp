#include "bus/clocks/clock.hpp"

namespace priamos::bus {
namespace {

template <class ChronoClock>
Duration SinceEpoch() {
  return std::chrono::duration_cast<Duration>(ChronoClock::now().time_since_epoch());
}

}  // namespace

MonotonicClock::MonotonicClock()
    : unix_minus_monotonic_(SinceEpoch<std::chrono::system_clock>() -
                            SinceEpoch<std::chrono::steady_clock>()) {}

Time MonotonicClock::Now() const {
  return Time(SinceEpoch<std::chrono::steady_clock>() + unix_minus_monotonic_);
}

}  // namespace priamos::bus
