#include "world/core/base/start_anywhere.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <array>

namespace priamos::world {
namespace {

GroundPlan Room() {
  GroundPlan map;
  for (const auto& ends :
       {std::array{0.0, 0.0, 6.0, 0.0}, {6.0, 0.0, 6.0, 4.0}, {6.0, 4.0, 0.0, 4.0}, {0.0, 4.0, 0.0, 0.0}}) {
    WallPlan wall;
    wall.from_m = {ends[0], ends[1]};
    wall.to_m = {ends[2], ends[3]};
    map.walls.push_back(wall);
  }
  return map;
}

TEST(StartAnywhere, FreePlacesAllOverTheRoomInEveryDirection) {
  const GroundPlan map = Room();
  Eigen::AlignedBox2d places;
  double least_yaw = kPi, most_yaw = -kPi;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto place = DrawFreePlace(map, {}, {}, {}, seed);
    ASSERT_TRUE(place);
    places.extend(place->translation());
    least_yaw = std::min(least_yaw, place->yaw);
    most_yaw = std::max(most_yaw, place->yaw);
  }
  EXPECT_LT(places.min().x(), 0.5);
  EXPECT_GT(places.max().x(), 5.5);
  EXPECT_LT(least_yaw, -2.8);
  EXPECT_GT(most_yaw, 2.8);
}

TEST(StartAnywhere, PeopleAndHolesAreKeptOff) {
  Hazards hazards;
  HolePlan hole;
  hole.x_m = 1.5;
  hole.y_m = 2;
  hole.length_m = 3;
  hole.width_m = 4;
  hazards.holes = {hole};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto place = DrawFreePlace(Room(), {}, {}, hazards, seed);
    ASSERT_TRUE(place);
    EXPECT_GT(place->x, 3.4);
  }
}

TEST(StartAnywhere, WhereNothingIsFreeThereIsNone) {
  Hazards hazards;
  HolePlan hole;
  hole.x_m = 3;
  hole.y_m = 2;
  hole.length_m = hole.width_m = 10;
  hazards.holes = {hole};
  EXPECT_FALSE(DrawFreePlace(Room(), {}, {}, hazards, 1));
}

}  // namespace
}  // namespace priamos::world
