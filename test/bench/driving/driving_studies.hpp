#pragma once

#include "test/bench/driving/driving_rig.hpp"

namespace priamos::bench {

/// Each prints its table and returns how many promises it found broken.
int StudyLatency(const RigOptions& options, int samples);
int StudyStops(const RigOptions& options, int episodes);
/// `only`: which sources, by a part of their name; empty: all.
int StudyEstop(const RigOptions& options, int episodes, int saturated_episodes, const std::string& only);
/// `only`: which processes, by a part of their name; empty: all, and the supervisor.
int StudyCrashes(const RigOptions& options, int rounds, const std::string& only);
int StudyBurden(const RigOptions& options, int seconds);
int StudyStalls(const RigOptions& options, int rounds);

}  // namespace priamos::bench
