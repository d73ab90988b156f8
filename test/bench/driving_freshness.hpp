#pragma once

#include "test/bench/driving_rig.hpp"

namespace priamos::bench {

/// Whether every motion had a fresh command behind it.
struct Freshness {
  int motions = 0;         ///< wheel commands that were not zero
  int stale = 0;           ///< of them: sent when every drive command's time-to-live was over
  Duration oldest{-1};     ///< age of the newest drive command behind a motion, most
  Duration beyond_ttl{0};  ///< how long its time-to-live was over, most
};

/// What a robot that looks 50 times a second, and this process that sees its messages, may be late.
inline constexpr Duration kLate{50'000};

/// From what was seen on the robot's own bus; `commands` must reach a time-to-live farther back than
/// `wheels`.
Freshness MeasureFreshness(const std::vector<Seen<wheel_command_t>>& wheels,
                           const std::vector<Seen<drive_command_t>>& commands);

}  // namespace priamos::bench
