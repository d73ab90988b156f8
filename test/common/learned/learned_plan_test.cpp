#include "common/learned/learned_plan.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

LearnedWall Face(int id, double x_m, double y_m, double yaw_deg, double length_m) {
  LearnedWall wall;
  wall.id = id;
  wall.x_m = x_m;
  wall.y_m = y_m;
  wall.yaw_deg = yaw_deg;
  wall.length_m = length_m;
  return wall;
}

TEST(LearnedPlanTest, NothingLearnedIsAnEmptyPlan) {
  EXPECT_THAT(PlanOf({}, 0.98).walls, IsEmpty());
}

TEST(LearnedPlanTest, ItSaysHowWellItsWallsAreKnown) {
  LearnedWalls learned{1, 1, {Face(1, 2, 1, 0, 3), Face(2, 2, 5, 0, 3), Face(3, 2, 9, 0, 3)}, {}};
  for (LearnedWall& wall : learned.walls) wall.sigma_across_m = 0.1 * wall.id;
  EXPECT_NEAR(PlanOf(learned, 0.98).wall_sigma_m, 0.2, 1e-9);
  for (LearnedWall& wall : learned.walls) wall.sigma_across_m = 0.9;
  EXPECT_NEAR(PlanOf(learned, 0.98).wall_sigma_m, 0.32, 1e-9) << "as much as a plan takes";
}

TEST(LearnedPlanTest, WallsThatNoPlanTakesAreLeftOut) {
  EXPECT_THAT(
      PlanOf({1, 1, {Face(1, 150, 1, 0, 3), Face(2, 2, 1, 0, 0), Face(3, 2, 1, 0, 3)}, {}}, 0.98).walls,
      SizeIs(1));
}

TEST(LearnedPlanTest, TheWallIsBehindTheFaceThatWasHeard) {
  const GroundPlan dut = PlanOf({1, 1, {Face(4, 2, 1, 0, 3)}, {}}, 0.98);
  ASSERT_THAT(dut.walls, SizeIs(1));
  EXPECT_EQ(dut.walls[0].name, "learned 4");
  EXPECT_NEAR((dut.walls[0].from() - Eigen::Vector2d(0.5, 0.95)).norm(), 0, 1e-9);
  EXPECT_NEAR((dut.walls[0].to() - Eigen::Vector2d(3.5, 0.95)).norm(), 0, 1e-9);
  EXPECT_EQ(dut.walls[0].thickness_m, 0.10);
}

TEST(LearnedPlanTest, ItIsAsThickAsTheFaceBehindItIsAway) {
  const GroundPlan dut = PlanOf({1, 1, {Face(1, 2, 1, 0, 3), Face(2, 2.5, 0.86, 180, 2)}, {}}, 0.98);
  ASSERT_THAT(dut.walls, SizeIs(2));
  for (const WallPlan& wall : dut.walls) {
    EXPECT_NEAR(wall.thickness_m, 0.14, 1e-9);
    EXPECT_NEAR(wall.from().y(), 0.93, 1e-9);
  }
}

TEST(LearnedPlanTest, AGapThatNeedsLeadingIsADoorWithoutALeaf) {
  const auto with_gap = [](double width_m) {
    return PlanOf({1, 1, {Face(1, 1, 0, 0, 2), Face(2, 3 + width_m, 0, 0, 2)}, {}}, 0.98);
  };
  EXPECT_THAT(with_gap(0.6).doors, IsEmpty());
  EXPECT_THAT(with_gap(1.3).doors, IsEmpty());
  const GroundPlan dut = with_gap(0.9);
  ASSERT_THAT(dut.doors, SizeIs(1));
  EXPECT_EQ(dut.doors[0].leaf, "none");
  EXPECT_NEAR(dut.doors[0].opening_width_m, 0.9, 1e-9);
  EXPECT_NEAR(dut.doors[0].x_m, 2.45, 1e-9);
  EXPECT_NEAR(dut.doors[0].y_m, -0.05, 1e-9);
  EXPECT_NEAR(dut.doors[0].yaw_deg, -90, 1e-9) << "away from where the wall was heard";
}

TEST(LearnedPlanTest, APlannerReadsWhatIsPrinted) {
  std::ostringstream text;
  PrintConfig(text, PlanOf({1, 1, {Face(1, 1, 0, 0, 2), Face(2, 3.9, 0, 0, 2)}, {}}, 0.98));
  const auto read = ParseConfig<GroundPlan>("plan.toml", text.str());
  EXPECT_THAT(read.walls, SizeIs(2));
  EXPECT_THAT(read.doors, SizeIs(1));
}

}  // namespace
}  // namespace priamos
