#pragma once

#include <cstdint>

#include "common/ground_plan.hpp"
#include "common/random.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::bench {

/// A corridor of an office building as the seed draws it, along the map's x axis: doors of several widths and
/// heights in both walls and at the end, hung left or right, closed, ajar or open, into the room or into the
/// corridor; between them what resembles doors: posters, notice boards, windows, panels of a door's height,
/// cupboards, pillars; or bare wall.
struct CorridorPlan {
  GroundPlan map;
  world::WorldPlan world;
  world::SceneConfig light;
  double length_m = 0, width_m = 0;
};

CorridorPlan DrawCorridor(std::uint64_t seed);

}  // namespace priamos::bench
