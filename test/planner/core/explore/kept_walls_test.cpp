#include "planner/core/explore/kept_walls.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

LearnedWalls One(const LearnedWall& wall) {
  return {1, 1, {wall}};
}

TEST(KeptWallsTest, AWallIsKeptAsItWasWhenItWasLeft) {
  KeptWalls dut;
  dut.Learn(One(WallAt(2, 1, 0, 3)), 1002);
  EXPECT_THAT(dut.Faces(), IsEmpty()) << "it is still heard";
  dut.Learn(One(WallAt(2, 1, 0, 3)), 1030);
  ASSERT_THAT(dut.Faces(), SizeIs(1));
  dut.Learn(One(WallAt(2, 1.2, 0, 3)), 1060);
  ASSERT_THAT(dut.Faces(), SizeIs(1));
  const WallFace face = dut.Faces()[0];
  EXPECT_NEAR((face.from - Eigen::Vector2d(0.5, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR((face.to - Eigen::Vector2d(3.5, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR(face.sigma_m, WallAt(2, 1, 0, 3).SigmaAt(1.5), 1e-9);
}

TEST(KeptWallsTest, TheSameWallUnderAnotherNumberIsNotKeptTwice) {
  KeptWalls dut;
  dut.Learn(One(WallAt(2, 1, 0, 3)), 1030);
  LearnedWall again = WallAt(2.5, 1.2, 2, 3), behind = WallAt(2.5, 0.8, 180, 3), beyond = WallAt(6, 1, 0, 3);
  again.id = 2;
  behind.id = 3;
  beyond.id = 4;
  dut.Learn({1, 2, {again}}, 1030);
  EXPECT_THAT(dut.Faces(), SizeIs(1));
  dut.Learn({1, 3, {behind, beyond}}, 1030);
  EXPECT_THAT(dut.Faces(), SizeIs(3));
  dut.Reset();
  EXPECT_THAT(dut.Faces(), IsEmpty());
}

TEST(KeptWallsTest, AShortOrUncertainWallIsNotKept) {
  KeptWalls dut;
  LearnedWall vague = WallAt(2, 5, 0, 3);
  vague.id = 2;
  vague.sigma_across_m = 0.2;
  dut.Learn({1, 1, {WallAt(2, 1, 0, 0.7), vague}}, 1030);
  EXPECT_THAT(dut.Faces(), IsEmpty());
}

}  // namespace
}  // namespace priamos::planner
