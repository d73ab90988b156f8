#include "world/core/base/start_anywhere.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "common/random.hpp"
#include "common/rectangle.hpp"

namespace priamos::world {
namespace {

constexpr int kDraws = 10000;
constexpr double kOff_m = 0.15, kOffPerson_m = 0.6;

bool IsOff(const Rectangle& footprint, const Hazards& hazards) {
  for (const HolePlan& hole : hazards.holes) {
    const Rectangle outline{{hole.x_m, hole.y_m, 0}, {hole.length_m / 2, hole.width_m / 2}};
    if (Distance(footprint, outline) < kOff_m) return false;
  }
  for (const PersonPlan& person : hazards.people)
    for (const PersonStop& stop : person.waypoints)
      if (Distance(footprint, Eigen::Vector2d(stop.x_m, stop.y_m)) < kOffPerson_m) return false;
  return true;
}

}  // namespace

std::optional<Pose2> DrawFreePlace(const GroundPlan& map, const Body& body, const std::vector<Solid>& solids,
                                   const Hazards& hazards, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "start anywhere");
  Eigen::AlignedBox2d within;
  for (const WallPlan& wall : map.walls) within.extend(wall.from()).extend(wall.to());
  if (within.isEmpty()) return std::nullopt;
  const Clearance clearance(body, solids);
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 place{rng.Uniform(within.min().x(), within.max().x()),
                      rng.Uniform(within.min().y(), within.max().y()), rng.Uniform(-kPi, kPi)};
    if (clearance.Gap(place, 1) >= kOff_m && IsOff({place, body.size_m / 2}, hazards)) return place;
  }
  return std::nullopt;
}

}  // namespace priamos::world
