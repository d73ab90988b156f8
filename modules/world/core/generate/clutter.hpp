#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// Where nothing may stand: straight pieces one after the other, `half_m` to either side.
struct Lane {
  std::vector<Eigen::Vector2d> points;
  double half_m = 0.625;

  double DistanceTo(const Eigen::Vector2d& at) const;
};

/// A rectangle along the axes of the map where clutter may stand.
struct Ground {
  Eigen::Vector2d low, high;
};

/// A thing of that kind (StrewnKinds) with dimensions and direction drawn, in the origin of the map. A table
/// is its top alone.
BoxPlan DrawThing(const std::string& kind, Rng& rng);
/// Adds a thing to the boxes of a world: a table with its legs.
void AddThing(const std::string& kind, const BoxPlan& thing, WorldPlan& world);

/// Looks for a place on the ground where the thing keeps 10 cm to the boxes of the world and `is_free` agrees
/// (middle, radius around it); false when there is none after some tries.
bool PlaceThing(const Ground& ground, const std::function<bool(const Eigen::Vector2d&, double)>& is_free,
                const WorldPlan& world, Rng& rng, BoxPlan& thing);

/// Adds up to `count` things at random places of `ground`, beside the lane: cartons, cupboards, bins, tables
/// on four legs, posts of 2 to 15 cm. One that finds no place after some tries is left out.
void AddClutter(const Ground& ground, const Lane& lane, int count, Rng& rng, WorldPlan& world);

}  // namespace priamos::world
