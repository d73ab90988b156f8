#pragma once

#include "test/bench/driving_rig.hpp"

namespace priamos::bench {

/// Each prints its table and returns how many promises it found broken.
int StudyLatency(const RigOptions& options, int samples);
int StudyStops(const RigOptions& options, int episodes);
int StudyEstop(const RigOptions& options, int episodes, int saturated_episodes);
int StudyCrashes(const RigOptions& options, int rounds);
int StudyStalls(const RigOptions& options, int rounds);

}  // namespace priamos::bench
