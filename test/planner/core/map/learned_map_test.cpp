#include "planner/core/map/learned_map.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>

#include "common/random.hpp"
#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

SeenFeature Seen(int store, int id, const LearnedWall& wall) {
  return {store, id, wall};
}

SeenFeature PointSeen(int store, int id, double x_m, double y_m = 0) {
  return {store, id, LearnedPoint{x_m, y_m, 0.02, 1000}};
}

TEST(LearnedMap, WhatIsToldAgainReplacesWhatWasTold) {
  LearnedMap dut({});
  EXPECT_TRUE(dut.Take(Seen(1, 7, WallAt(0, 0, 0, 2))));
  EXPECT_TRUE(dut.Take(Seen(1, 7, WallAt(1, 0.1, 0, 4))));
  ASSERT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_EQ(dut.walls().walls[0].y_m, 0.1) << "the newest, not a mixture: it rests on all that was heard";
  EXPECT_EQ(dut.walls().walls[0].length_m, 4);
  EXPECT_EQ(dut.walls().walls[0].sightings, 2);
  EXPECT_EQ(dut.walls().revision, 2);
}

TEST(LearnedMap, AWallThatIsFoundASecondTimeIsOne) {
  LearnedMap dut({});
  dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
  dut.Take(Seen(2, 1, WallAt(1, 0.02, 0.5, 3)));
  ASSERT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_NEAR(dut.walls().walls[0].length_m, 4, 0.05);
  EXPECT_NEAR(dut.walls().walls[0].y_m, 0.01, 0.01);
}

TEST(LearnedMap, OtherWallsStayOthers) {
  for (const LearnedWall& other :
       {WallAt(0, 0.4, 0, 3), WallAt(0, 0, 20, 3), WallAt(0, 0.05, 180, 3), WallAt(3.6, 0, 0, 3)}) {
    LearnedMap dut({});
    dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
    dut.Take(Seen(1, 2, other));
    EXPECT_THAT(dut.walls().walls, SizeIs(2)) << other.x_m << " " << other.y_m << " " << other.yaw_deg;
  }
}

TEST(LearnedMap, PiecesThatFollowEachOtherAreOneUntilItIsLong) {
  LearnedMap dut({});
  for (int i = 0; i < 8; ++i) dut.Take(Seen(1, i, WallAt(4 * i, 0, 0, 4)));
  ASSERT_THAT(dut.walls().walls, SizeIs(3));
  double whole_m = 0;
  for (const LearnedWall& wall : dut.walls().walls) whole_m += wall.length_m;
  EXPECT_NEAR(whole_m, 32, 0.1);
}

TEST(LearnedMap, AWallThatBridgesTwoMakesOneOfThree) {
  LearnedMap dut({});
  dut.Take(Seen(1, 1, WallAt(0, 0, 0, 2)));
  dut.Take(Seen(1, 2, WallAt(4, 0, 0, 2)));
  ASSERT_THAT(dut.walls().walls, SizeIs(2));
  dut.Take(Seen(1, 3, WallAt(2, 0, 0, 2)));
  ASSERT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_EQ(dut.walls().walls[0].id, 1);
  EXPECT_NEAR(dut.walls().walls[0].length_m, 6, 0.05);
}

TEST(LearnedMap, OnePieceThatTurnsOutElsewhereLeavesTheRest) {
  LearnedMap dut({});
  dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
  dut.Take(Seen(1, 2, WallAt(1, 0, 0, 3)));
  ASSERT_THAT(dut.walls().walls, SizeIs(1));
  dut.Take(Seen(1, 2, WallAt(1, 1.0, 0, 3)));
  EXPECT_THAT(dut.walls().walls, SizeIs(2));
}

TEST(LearnedMap, WhatHasGoneIsForgottenAndResetForgetsAll) {
  LearnedMap dut({});
  dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
  dut.Take(Seen(1, 2, WallAt(0, 5, 0, 3)));
  const SeenFeature gone{1, 2};
  EXPECT_TRUE(dut.Take(gone));
  EXPECT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_FALSE(dut.Take(gone)) << "it is not there any more";
  const int revision = dut.walls().revision;
  dut.Reset();
  EXPECT_THAT(dut.walls().walls, IsEmpty());
  EXPECT_GT(dut.walls().revision, revision);
  EXPECT_TRUE(dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3))));
  EXPECT_THAT(dut.walls().walls, SizeIs(1));
}

TEST(LearnedMap, APointThatMovesUnderItsNumberLeavesNoneBehind) {
  LearnedMap dut({});
  EXPECT_TRUE(dut.Take(PointSeen(1, 7, 1)));
  EXPECT_TRUE(dut.Take(PointSeen(1, 8, 3)));
  EXPECT_TRUE(dut.Take(PointSeen(1, 7, 1.25)));
  ASSERT_THAT(dut.walls().points, SizeIs(2));
  EXPECT_EQ(dut.walls().points[0].id, 1);
  EXPECT_EQ(dut.walls().points[0].x_m, 1.25);
  EXPECT_EQ(dut.walls().revision, 3);
}

TEST(LearnedMap, APointThatIsSeenThroughIsNone) {
  LearnedMap dut({});
  dut.Take(PointSeen(1, 7, 1));
  dut.Take(PointSeen(1, 8, 3));
  EXPECT_FALSE(dut.Take(SeenFeature{2, 7})) << "another store";
  EXPECT_TRUE(dut.Take(SeenFeature{1, 7}));
  ASSERT_THAT(dut.walls().points, SizeIs(1));
  EXPECT_EQ(dut.walls().points[0].x_m, 3);
  EXPECT_FALSE(dut.Take(SeenFeature{1, 7})) << "it is not there any more";
}

TEST(LearnedMap, ANumberThatChangesItsKindReplacesWhatItWas) {
  LearnedMap dut({});
  dut.Take(Seen(1, 7, WallAt(0, 0, 0, 2)));
  dut.Take(PointSeen(1, 7, 1));
  EXPECT_THAT(dut.walls().walls, IsEmpty());
  EXPECT_THAT(dut.walls().points, SizeIs(1));
  dut.Take(Seen(1, 7, WallAt(0, 0, 0, 2)));
  EXPECT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_THAT(dut.walls().points, IsEmpty());
  EXPECT_TRUE(dut.Take(SeenFeature{1, 7}));
  EXPECT_THAT(dut.walls().walls, IsEmpty());
}

TEST(LearnedMap, APieceThatBecomesAPointLeavesTheRestOfItsWall) {
  LearnedMap dut({});
  dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
  dut.Take(Seen(1, 2, WallAt(1, 0, 0, 3)));
  dut.Take(PointSeen(1, 2, 1));
  EXPECT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_THAT(dut.walls().points, SizeIs(1));
}

TEST(LearnedMap, WhatAFileHoldsIsFoundAgain) {
  LearnedMap before({});
  before.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
  LearnedMap dut({}, before.walls());
  dut.Take(Seen(99, 1, WallAt(0.5, 0.01, 0, 3)));
  ASSERT_THAT(dut.walls().walls, SizeIs(1));
  dut.Take(Seen(99, 1, WallAt(0.5, 0.01, 0, 3.2)));
  EXPECT_NEAR(dut.walls().walls[0].length_m, 3.6, 0.05) << "the file's part of it stays";
}

TEST(LearnedMap, KeepsNoMoreThanItMay) {
  LearnedMap dut({.most = 10});
  for (int i = 0; i < 30; ++i) {
    LearnedWall wall = WallAt(0, i, 0, 2);
    wall.seen_s = 1000 + i;
    dut.Take(Seen(1, i, wall));
  }
  ASSERT_THAT(dut.walls().walls, SizeIs(10));
  for (const LearnedWall& wall : dut.walls().walls) EXPECT_GE(wall.y_m, 20) << "what was seen last";
}

TEST(LearnedMap, AMapThatWasMadeAnewKeepsDoorsAndThings) {
  LearnedMap dut({});
  dut.Take(Seen(1, 1, WallAt(0, 0, 0, 3)));
  LearnedDoor door;
  door.seen_s = 5;
  EXPECT_TRUE(dut.Take(door));
  EXPECT_TRUE(dut.Take(BoxAt(2, 1, 0)));
  EXPECT_FALSE(dut.Take(BoxAt(2, 1, 0)));
  const int revision = dut.walls().revision;
  LearnedWalls made;
  made.walls = {WallAt(5, 0, 0, 3)};
  dut.Replace(made);
  EXPECT_EQ(dut.walls().walls[0].x_m, 5);
  EXPECT_THAT(dut.walls().doors, SizeIs(1));
  ASSERT_THAT(dut.walls().objects, SizeIs(1));
  EXPECT_GT(dut.walls().revision, revision);
  made.objects = {BoxAt(2.3, 1, 0)};
  dut.Replace(made);
  ASSERT_THAT(dut.walls().objects, SizeIs(1));
  EXPECT_EQ(dut.walls().objects[0].x_m, 2.3) << "where the map has it";
  dut.Reset();
  EXPECT_THAT(dut.walls().objects, SizeIs(0));
}

/// Sightings that share the error of one pose, as all of one drive do, make the map no surer than that pose.
TEST(LearnedMap, SharedErrorsDoNotAverageOut) {
  LearnedMap dut({});
  for (int store = 1; store <= 20; ++store) dut.Take(Seen(store, 1, WallAt(0, 0.03, 0, 3)));
  ASSERT_THAT(dut.walls().walls, SizeIs(1));
  EXPECT_NEAR(dut.walls().walls[0].sigma_across_m, WallAt(0, 0, 0, 3).sigma_across_m, 0.003);
}

/// In whatever order pieces come, they cover what they covered.
RC_GTEST_PROP(LearnedMap, NothingIsLostByPuttingTogether, ()) {
  Rng rng(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 20)));
  LearnedMap dut({});
  std::vector<LearnedWall> told;
  for (int i = 0; i < 12; ++i) {
    const bool lower = rng.Chance(0.5);
    const double sigma_m = 0.02;
    told.push_back(WallAt(rng.Uniform(0, 10), (lower ? 0 : 2) + rng.Normal(sigma_m / 2), rng.Normal(0.3),
                          rng.Uniform(0.6, 3)));
    dut.Take(Seen(1, i, told.back()));
  }
  for (const LearnedWall& wall : told) {
    for (const double part : {-0.45, 0.0, 0.45}) {
      const Eigen::Vector2d at = wall.At(part * wall.length_m);
      double nearest_m = 9;
      for (const LearnedWall& kept : dut.walls().walls) {
        const Eigen::Vector2d own = kept.map_from_wall().Inverse() * at;
        nearest_m =
            std::min(nearest_m, std::hypot(std::max(0.0, std::abs(own.x()) - kept.length_m / 2), own.y()));
      }
      RC_ASSERT(nearest_m < 0.15);
    }
  }
}

}  // namespace
}  // namespace priamos::planner
