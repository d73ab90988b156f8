#include "common/learned/wall_gaps.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos {
namespace {

using planner::WallAt;
using testing::IsEmpty;
using testing::SizeIs;

LearnedWalls Walls(std::vector<LearnedWall> walls) {
  LearnedWalls learned;
  for (std::size_t i = 0; i < walls.size(); ++i) walls[i].id = static_cast<int>(i) + 1;
  learned.walls = std::move(walls);
  return learned;
}

TEST(GapsOf, ADoorwayIsAGap) {
  const auto dut = GapsOf(Walls({WallAt(0, 0, 0, 4), WallAt(5, 0.02, 0.5, 4)}));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_NEAR(dut[0].width_m, 1, 0.01);
  EXPECT_NEAR(dut[0].x_m, 2.5, 0.01);
  EXPECT_EQ(dut[0].before, 1);
  EXPECT_EQ(dut[0].behind, 2);
  EXPECT_NEAR(dut[0].sigma_width_m, std::sqrt(0.02), 0.01);
}

TEST(GapsOf, OtherPairsAreNone) {
  EXPECT_THAT(GapsOf(Walls({WallAt(0, 0, 0, 4), WallAt(4.2, 0, 0, 4)})), IsEmpty()) << "too narrow";
  EXPECT_THAT(GapsOf(Walls({WallAt(0, 0, 0, 4), WallAt(9, 0, 0, 4)})), IsEmpty()) << "too wide";
  EXPECT_THAT(GapsOf(Walls({WallAt(0, 0, 0, 4), WallAt(5, 0.5, 0, 4)})), IsEmpty()) << "not on one line";
  EXPECT_THAT(GapsOf(Walls({WallAt(0, 0, 0, 4), WallAt(5, 0, 180, 4)})), IsEmpty()) << "of two sides";
}

TEST(GapsOf, TheNearestWallBehindCounts) {
  const auto dut = GapsOf(Walls({WallAt(0, 0, 0, 2), WallAt(4.5, 0, 0, 1), WallAt(2.4, 0, 0, 1)}));
  ASSERT_THAT(dut, SizeIs(2));
  EXPECT_EQ(dut[0].behind, 3);
}

TEST(CornersOf, WallsWhoseEndsMeetMakeOne) {
  // A room's lower wall, heard from above, and its right wall, heard from the left.
  const auto dut = CornersOf(Walls({WallAt(0, 0, 0, 4), WallAt(2.1, 1.5, 90, 2.6)}));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_NEAR(dut[0].x_m, 2.1, 1e-6);
  EXPECT_NEAR(dut[0].y_m, 0, 1e-6);
  EXPECT_TRUE(dut[0].inner);
  const auto outer = CornersOf(Walls({WallAt(0, 0, 0, 4), WallAt(2.0, -1.5, -90, 2.8)}));
  ASSERT_THAT(outer, SizeIs(1));
  EXPECT_FALSE(outer[0].inner);
}

TEST(CornersOf, WallsThatDoNotMeetMakeNone) {
  EXPECT_THAT(CornersOf(Walls({WallAt(0, 0, 0, 4), WallAt(5, 1.5, 90, 2)})), IsEmpty());
  EXPECT_THAT(CornersOf(Walls({WallAt(0, 0, 0, 4), WallAt(0, 2, 90, 4)})), IsEmpty()) << "it ends on it";
  EXPECT_THAT(CornersOf(Walls({WallAt(0, 0, 0, 4), WallAt(4, 0.3, 8, 4)})), IsEmpty()) << "nearly parallel";
}

}  // namespace
}  // namespace priamos
