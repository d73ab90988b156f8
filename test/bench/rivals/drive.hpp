#pragma once

#include <cstdint>
#include <functional>

#include "test/bench/rivals/case.hpp"
#include "test/bench/rivals/driver.hpp"

namespace priamos::bench {

/// What became of one drive, by the world's truth.
struct Drive {
  bool arrived = false;  ///< the middle of the base came within kThere_m of the goal
  double seconds = 0;    ///< until then
  int contacts = 0;      ///< that the base drove into, people included
  int came = 0;          ///< people who walked into it
  double min_gap_m = 0;  ///< to what stands still, and to who moves while the base comes nearer
  double step_s = 0;     ///< CPU time of the driver for one of its steps, mean

  bool passed() const { return arrived && contacts == 0; }
};

/// So near to the goal a drive has arrived [m].
inline constexpr double kThere_m = 0.3;

/// Sees what a drive hears and where the base truly is: for measurements beside it.
using Witness = std::function<void(const Heard&, const Pose2& map_from_base)>;

/// Drives a case in simulated time, until it has arrived, stands for 15 s, or takes five times as long as its
/// path would take. Noise of wheels and sonars comes from the seed alone.
Drive DriveCase(const Case& task, const world::RobotModel& model, Driver& driver, std::uint64_t seed,
                const Witness& witness = {});

}  // namespace priamos::bench
