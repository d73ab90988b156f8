#pragma once

#include <Eigen/Core>
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

/// Adds up to `count` things at random places of `ground`, beside the lane: cartons, cupboards, bins, tables
/// on four legs, posts of 2 to 15 cm. One that finds no place after some tries is left out.
void AddClutter(const Ground& ground, const Lane& lane, int count, Rng& rng, WorldPlan& world);

}  // namespace priamos::world
