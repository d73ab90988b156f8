#pragma once

#include <chrono>
#include <cstdint>

namespace priamos {

/// Microseconds: the resolution of every time in the system.
using Duration = std::chrono::microseconds;

/// The clock all time stamps belong to. It never steps: in real time it is the monotonic clock, anchored
/// once per process to Unix time; in lockstep it is the simulated clock. Nothing in a core reads it: time
/// is always an argument.
struct StampClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<StampClock, Duration>;
  static constexpr bool is_steady = true;
};
using Time = StampClock::time_point;

/// Time stamp for the field `utime` of messages: microseconds of StampClock.
constexpr std::int64_t ToUtime(Time t) {
  return t.time_since_epoch().count();
}
constexpr Time FromUtime(std::int64_t utime) {
  return Time(Duration(utime));
}

constexpr double Seconds(Duration d) {
  return std::chrono::duration<double>(d).count();
}
constexpr Duration FromSeconds(double s) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(s));
}

}  // namespace priamos
