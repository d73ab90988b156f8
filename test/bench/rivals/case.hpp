#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/ground_plan.hpp"
#include "test/bench/rivals/driver.hpp"
#include "world/core/scene/hazards.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::bench {

/// One task, the same for every driver: a world, a start, and the path to the goal that the planner orders,
/// who knows the walls as a person with a tape measured them and nothing else.
struct Case {
  std::vector<world::Solid> solids;
  world::Hazards hazards;
  Order order;
  double length_m = 0;  ///< of the path

  const Pose2& goal() const { return order.path.points.back(); }
};

/// What a family of worlds is called, and what is in them.
struct Family {
  std::string name, what;
};
const std::vector<Family>& Families();

/// The case of that seed. `deployment`: folder of configurations, whose worlds some families are. Throws
/// std::invalid_argument for an unknown family.
Case MakeCase(const std::string& family, std::uint64_t seed, const std::string& deployment);

}  // namespace priamos::bench
