#include "world/core/generate/generate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "world/core/base/contact.hpp"
#include "world/core/scene/build_solids.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

class GenerateTest : public ::testing::TestWithParam<std::string> {
 protected:
  static constexpr std::uint64_t kSeeds = 40;
};

/// Smallest gap of the footprint on the straight way between two places, heading along it.
double GapBetween(const Clearance& clearance, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double yaw = std::atan2(along.y(), along.x());
  double gap = 10;
  for (double part = 0; part <= 1; part += 0.01) {
    const Eigen::Vector2d at = from + part * along;
    gap = std::min(gap, clearance.Gap({at.x(), at.y(), yaw}, 10));
  }
  return gap;
}

TEST_P(GenerateTest, TheWayFromTheStartIsFree) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const GeneratedWorld dut = Generate(GetParam(), seed);
    const Clearance clearance(Body{}, BuildSolids(dut.truth, dut.world, seed));
    const Start start = DrawStart(dut.world.start, seed);
    EXPECT_GT(clearance.Gap(start.truth, 1), 0) << seed;
    Eigen::Vector2d at = start.nominal.translation();
    for (const Pose2& waypoint : dut.waypoints) {
      EXPECT_GT(GapBetween(clearance, at, waypoint.translation()), 0.1) << seed;
      at = waypoint.translation();
    }
    ASSERT_EQ(dut.round.empty(), !dut.waypoints.empty());
    for (const Pose2& place : dut.round) EXPECT_GT(clearance.Gap(place, 1), 0.1) << seed;
    if (!dut.waypoints.empty()) continue;
    const DoorPlan* door = dut.truth.FindDoor(dut.door_id);
    ASSERT_TRUE(door);
    EXPECT_GE(door->opening_width_m, 0.88);
    const Pose2 map_from_door = door->map_from_door();
    EXPECT_GT(GapBetween(clearance, at, (map_from_door * Pose2{-1.6, 0, 0}).translation()), 0.1) << seed;
    EXPECT_NEAR(GapBetween(clearance, (map_from_door * Pose2{-1.6, 0, 0}).translation(),
                           (map_from_door * Pose2{1.5, 0, 0}).translation()),
                (door->opening_width_m - 0.78) / 2, 1e-6)
        << seed;
  }
}

TEST_P(GenerateTest, PeopleHaveRoomWhereTheyStandAndNobodyStandsAtTheStart) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const GeneratedWorld dut = Generate(GetParam(), seed);
    const auto solids = BuildSolids(dut.truth, dut.world, seed);
    for (const PersonPlan& person : dut.world.people)
      for (const PersonStop& stop : person.waypoints) {
        for (const Solid& solid : solids)
          if (Overlaps(solid, 0.15, 1.75)) {
            EXPECT_GT(Distance(OutlineOf(solid), Eigen::Vector2d(stop.x_m, stop.y_m)), 0.25)
                << solid.name << seed;
          }
        EXPECT_GT(std::hypot(stop.x_m - dut.world.start.x_m, stop.y_m - dut.world.start.y_m), 1) << seed;
      }
  }
}

TEST_P(GenerateTest, TheMapIsWhatATapeGives) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const GeneratedWorld dut = Generate(GetParam(), seed);
    ASSERT_EQ(dut.truth.doors.size(), dut.surveyed.doors.size());
    double most_m = 0;
    for (std::size_t i = 0; i < dut.truth.doors.size(); ++i) {
      const DoorPlan &is = dut.truth.doors[i], &drawn = dut.surveyed.doors[i];
      EXPECT_EQ(is.id, drawn.id);
      const double off_m = std::hypot(is.x_m - drawn.x_m, is.y_m - drawn.y_m);
      EXPECT_LT(off_m, 0.12);
      EXPECT_GE(is.opening_width_m, 0.8);
      EXPECT_LE(is.opening_width_m, 1.0);
      EXPECT_LT(std::abs(drawn.opening_width_m - is.opening_width_m - 0.01), 0.035);
      most_m = std::max(most_m, off_m);
    }
    EXPECT_GT(most_m, 0.002) << seed;
  }
}

TEST_P(GenerateTest, WhatIsWrittenIsReadAgain) {
  const GeneratedWorld dut = Generate(GetParam(), 3);
  std::ostringstream map, world;
  PrintConfig(map, dut.surveyed);
  PrintConfig(world, dut.world);
  const auto read_map = ParseConfig<GroundPlan>("map.toml", map.str());
  const auto read = ParseConfig<WorldPlan>("world.toml", world.str());
  EXPECT_EQ(read_map.walls.size(), dut.surveyed.walls.size());
  EXPECT_EQ(read_map.doors.front().x_m, dut.surveyed.doors.front().x_m);
  ASSERT_EQ(read.boxes.size(), dut.world.boxes.size());
  EXPECT_EQ(read.boxes.back().x_m, dut.world.boxes.back().x_m);
  EXPECT_EQ(read.people.size(), dut.world.people.size());
}

TEST_P(GenerateTest, TheSeedDecides) {
  const auto text = [](std::uint64_t seed) {
    std::ostringstream out;
    PrintConfig(out, Generate(GetParam(), seed).world);
    return out.str();
  };
  EXPECT_EQ(text(5), text(5));
  EXPECT_NE(text(5), text(6));
}

INSTANTIATE_TEST_SUITE_P(All, GenerateTest, ::testing::ValuesIn(GeneratedKinds()));

TEST(GenerateKindTest, AnUnknownKindIsAnError) {
  EXPECT_THROW(Generate("tower", 1), std::invalid_argument);
}

TEST(CorridorTest, IsAsLongAndWideAsPromised) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const GroundPlan dut = Generate("corridor", seed).truth;
    double low = 0, high = 0, south = 0, north = 0;
    for (const WallPlan& wall : dut.walls) {
      low = std::min(low, wall.from_m[0]);
      high = std::max(high, wall.to_m[0]);
      if (wall.name.starts_with("south")) south = wall.from_m[1];
      if (wall.name == "north beyond") north = wall.from_m[1];
    }
    EXPECT_GT(high - low, 20);
    EXPECT_LT(high - low, 80.5);
    EXPECT_GE(north - south, 1.6 + 0.14 - 1e-9);
    EXPECT_LE(north - south, 3.0 + 0.14 + 1e-9);
  }
}

}  // namespace
}  // namespace priamos::world
