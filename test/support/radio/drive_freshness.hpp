#pragma once

#include <algorithm>
#include <vector>

#include "common/time.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos {

/// A message and when it was seen.
template <class T>
struct Seen {
  Time at{};
  T message{};
};

inline bool IsZero(const wheel_command_t& command) {
  return std::all_of(std::begin(command.speed_rad_s), std::end(command.speed_rad_s),
                     [](double s) { return s == 0; });
}

/// Whether every motion had a fresh command behind it.
struct Freshness {
  int motions = 0;     ///< wheel commands that were not zero
  int stale = 0;       ///< of them: sent when the time-to-live of every drive command was over
  Duration oldest{0};  ///< age of the newest drive command behind a motion, most
};

/// From what was seen on the robot's own bus; `commands` must reach a time-to-live farther back than
/// `wheels`. `late`: what a robot that looks 50 times a second, and who sees its messages, may be late.
inline Freshness MeasureFreshness(const std::vector<Seen<wheel_command_t>>& wheels,
                                  const std::vector<Seen<drive_command_t>>& commands, Duration late) {
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
    if (IsZero(wheel.message)) continue;
    ++all.motions;
    all.oldest = std::max(all.oldest, Duration(wheel.at - newest));
    all.stale += wheel.at > valid_until + late;
  }
  return all;
}

}  // namespace priamos
