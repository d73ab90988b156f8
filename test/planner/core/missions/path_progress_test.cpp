#include "planner/core/missions/path_progress.hpp"

#include <gmock/gmock.h>

namespace priamos::planner {
namespace {

using ::testing::SizeIs;

const std::vector<Pose2> kPath{{1, 0, 0}, {1, 2, 0}, {4, 2, 0}};

TEST(PathProgressTest, ThePointsThatAreLeft) {
  EXPECT_THAT(PointsLeft(kPath, 6), SizeIs(3));
  EXPECT_THAT(PointsLeft(kPath, 5.5), SizeIs(3));
  EXPECT_THAT(PointsLeft(kPath, 4), SizeIs(2));
  EXPECT_THAT(PointsLeft(kPath, 3), SizeIs(1));
  EXPECT_THAT(PointsLeft(kPath, 0), SizeIs(1));
  EXPECT_THAT(PointsLeft({}, 1), SizeIs(0));
}

constexpr double kSize_m = 0.4;
const Footprint kBase{.length_m = 0.9, .width_m = 0.8};

/// Met by a base at the origin that faces along x.
Rectangle Met(const Eigen::Vector2d& at) {
  return ThingMet({0, 0, 0}, {1, 0}, ThingNear{0.1, at}, kBase, kSize_m);
}

TEST(ThingMetTest, BeginsWhereItWasHeard) {
  const Rectangle dut = Met({0.6, 0});
  EXPECT_NEAR(dut.map_from_centre.x, 0.6 + kSize_m / 2, 1e-9);
  EXPECT_NEAR(dut.map_from_centre.y, 0, 1e-9);
  EXPECT_EQ(dut.half_m, Eigen::Vector2d(kSize_m / 2, kSize_m / 2));
}

TEST(ThingMetTest, AJambLeavesTheOpeningAsWideAsItIs) {
  EXPECT_NEAR(Met({0.6, 0.4}).map_from_centre.y, 0.4 + kSize_m / 2, 1e-9);
  EXPECT_NEAR(Met({0.6, -0.4}).map_from_centre.y, -0.4 - kSize_m / 2, 1e-9);
  EXPECT_NEAR(Met({0.6, -0.9}).map_from_centre.y, -0.9 - kSize_m / 2, 1e-9) << "met on an arc";
}

TEST(ThingMetTest, LiesInTheMap) {
  const Rectangle dut = ThingMet({3, 1, kPi / 2}, {0, 1}, ThingNear{0.1, {0.6, -0.4}}, kBase, kSize_m);
  EXPECT_NEAR(dut.map_from_centre.x, 3.4 + kSize_m / 2, 1e-9);
  EXPECT_NEAR(dut.map_from_centre.y, 1.6 + kSize_m / 2, 1e-9);
}

TEST(ThingMetTest, NothingHeardIsBeforeTheBase) {
  const Rectangle dut = ThingMet({0, 0, 0}, {0, 1}, std::nullopt, kBase, kSize_m);
  EXPECT_NEAR(dut.map_from_centre.x, 0, 1e-9);
  EXPECT_NEAR(dut.map_from_centre.y, 0.4 + kSize_m / 2, 1e-9);
}

}  // namespace
}  // namespace priamos::planner
