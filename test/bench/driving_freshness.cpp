#include "test/bench/driving_freshness.hpp"

#include <algorithm>

namespace priamos::bench {

Freshness MeasureFreshness(const std::vector<Seen<wheel_command_t>>& wheels,
                           const std::vector<Seen<drive_command_t>>& commands) {
  // Two channels may be read in another order than they were written.
  constexpr Duration kOrder{10'000};
  Freshness all;
  std::size_t heard = 0;
  Time newest{}, valid_until{};
  for (const auto& wheel : wheels) {
    for (; heard < commands.size() && commands[heard].at <= wheel.at + kOrder; ++heard) {
      const drive_command_t& c = commands[heard].message;
      newest = std::max(newest, FromUtime(c.utime));
      valid_until = std::max(valid_until, FromUtime(c.utime) + FromSeconds(c.time_to_live_s));
    }
    if (DrivingRig::IsZero(wheel.message)) continue;
    ++all.motions;
    all.oldest = std::max(all.oldest, wheel.at - newest);
    all.beyond_ttl = std::max(all.beyond_ttl, wheel.at - valid_until);
    all.stale += wheel.at > valid_until + kLate;
  }
  return all;
}

}  // namespace priamos::bench
