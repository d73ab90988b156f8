#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/scenario/true_world.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// A line that was shown while the run went on.
struct StoryLine {
  double t_s = 0;  ///< since the start of the run
  std::string text;
};

/// What the record itself does not contain about a run.
struct RunInfo {
  std::string scenario;
  std::uint64_t seed = 0;
  double realtime_factor = 1;
  std::optional<DoorPlan> door;  ///< the door that was to be passed, from the ground plan; none in it
  std::string reason;            ///< last line of the story
  std::vector<StoryLine> story;  ///< the lines shown meanwhile
  TrueWorld world;               ///< the simulated world of the run
};

}  // namespace priamos::cli
