#pragma once

#include <vector>

#include "common/ground_plan.hpp"
#include "test/bench/rivals/driver.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::bench {

/// Speed of every path [m/s], that of a mission as shipped.
inline constexpr double kPathSpeed_m_s = 0.3;

/// The order of the robot's planner to drive from `start` to `goal` over a plan. Where it finds no way, as
/// through an opening that leaves less than 10 cm beside the base, the straight lines over `instead`, whose
/// middle one is a narrow passage.
Order OrderBy(const GroundPlan& plan, const Pose2& start, const Pose2& goal,
              const std::vector<Pose2>& instead = {});

/// Whether the circle around the base with `beside_m` to spare gets from one place to the other among what
/// stands still.
bool CircleFits(const std::vector<world::Solid>& solids, const Pose2& from, const Pose2& to, double beside_m);

}  // namespace priamos::bench
