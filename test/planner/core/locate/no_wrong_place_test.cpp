#include <gmock/gmock.h>

#include <iostream>

#include "planner/core/locate/place_search.hpp"
#include "simulated_drive.hpp"

// Buildings made up of rectangles, things that are on no plan, and walls a little off their places: whenever
// one place is left, it is the true one.

namespace priamos::planner {
namespace {

/// Two to four rooms in a row, walls that stand in some of them, and how they were built.
struct Building {
  GroundPlan plan, built;
  std::vector<Rectangle> things;
};

Building MakeBuilding(Rng& rng) {
  Building b;
  double x_m = 0;
  const int rooms = 2 + static_cast<int>(rng.Below(3));
  for (int i = 0; i < rooms; ++i) {
    const Eigen::Vector2d size(rng.Uniform(3, 7), rng.Uniform(3, 6));
    AddRoom(b.plan, {x_m, 0}, size);
    if (rng.Chance(0.5)) {
      const double at_m = x_m + rng.Uniform(1.5, size.x() - 1);
      b.plan.walls.push_back(WallBetween(at_m, 0, at_m, rng.Uniform(0.7, size.y() - 1.5)));
    }
    for (int n = static_cast<int>(rng.Below(4)); n > 0; --n)
      b.things.push_back({{x_m + rng.Uniform(0.2, size.x() - 0.2), rng.Uniform(0.2, size.y() - 0.2),
                           rng.Chance(0.7) ? 0 : rng.Uniform(0, 3)},
                          {rng.Uniform(0.2, 0.6), rng.Uniform(0.2, 0.6)}});
    x_m += size.x() + 0.14;
  }
  b.built = b.plan;
  for (WallPlan& wall : b.built.walls) {
    const double off_m = rng.Uniform(-0.06, 0.06);
    for (auto* end : {&wall.from_m, &wall.to_m})
      for (double& c : *end) c += off_m;
  }
  return b;
}

/// A free place in it; nullopt when none was found.
std::optional<Pose2> FreePlace(const Building& b, Rng& rng) {
  for (int i = 0; i < 200; ++i) {
    const Pose2 place{rng.Uniform(0, 24), rng.Uniform(0, 6), rng.Uniform(-kPi, kPi)};
    const PlacePlan plan(b.plan);
    if (!plan.bounds().contains(place.translation())) continue;
    if (SimulatedDrive(b.built, b.things, place, rng).IsFree(place)) return place;
  }
  return std::nullopt;
}

TEST(NoWrongPlace, OneThatIsAloneIsTheTrueOne) {
  constexpr int kBuildings = 60, kLegs = 10;
  int right = 0, several = 0;
  for (int seed = 0; seed < kBuildings; ++seed) {
    Rng rng = Rng::Stream(static_cast<std::uint64_t>(seed), "no wrong place");
    const Building b = MakeBuilding(rng);
    const auto place = FreePlace(b, rng);
    if (!place) continue;
    SimulatedDrive drive(b.built, b.things, *place, rng);
    for (int leg = 2; leg <= kLegs; leg += 4) {
      drive.LookAround(4);
      const auto found = FindPlaces({}, PlacePlan(b.plan), drive.way());
      if (found.size() != 1 || !found[0].IsPoint()) {
        several += leg == kLegs;
        continue;
      }
      const Pose2 off = drive.truth().Inverse() * found[0].map_from_base;
      EXPECT_LT(off.translation().norm(), 0.45) << "seed " << seed << " leg " << leg;
      EXPECT_LT(std::abs(off.yaw), Radians(8)) << "seed " << seed << " leg " << leg;
      right += leg == kLegs;
    }
  }
  std::cout << right << " alone, " << several << " not, of " << kBuildings << "\n";
  EXPECT_GE(right, 2);
}

}  // namespace
}  // namespace priamos::planner
