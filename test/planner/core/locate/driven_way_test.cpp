#include "planner/core/locate/driven_way.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

SeenFeature Seen(int id, double s, LearnedWall wall) {
  wall.seen_s = 1000 + s;
  return {1, id, wall};
}

/// A log that begins with the base in (1, 2), looking along y.
WayLog Begun() {
  WayLog log;
  log.Begin(At(0));
  log.OnPose(At(0.1), {1, 2, kPi / 2}, std::nullopt);
  return log;
}

TEST(WayLog, FollowsThePoseAndCountsTheWay) {
  WayLog log = Begun();
  for (int i = 1; i <= 10; ++i) log.OnPose(At(0.1 + i), {1, 2 + 0.1 * i, kPi / 2}, std::nullopt);
  EXPECT_NEAR(log.driven_m(), 1, 1e-9);
  EXPECT_NEAR(log.way().base().y, 3, 1e-9);
  EXPECT_GT(log.way().trail.size(), 4U);
}

TEST(WayLog, APoseThatIsSetLeavesTheWayWhereItWas) {
  WayLog log = Begun();
  log.OnPose(At(2), {7, 7, 0}, At(1));  // the base has not moved
  log.OnPose(At(3), {8, 7, 0}, At(1));
  EXPECT_NEAR(log.driven_m(), 1, 1e-9);
  EXPECT_NEAR(log.way_from_base().x, 1, 1e-9);
  EXPECT_NEAR(log.way_from_base().y, 3, 1e-9);
}

TEST(WayLog, APoseOfBeforeACorrectionDoesNotCount) {
  WayLog log = Begun();
  log.OnPose(At(2), {50, 50, 0}, At(3));
  EXPECT_NEAR(log.driven_m(), 0, 1e-9);
}

TEST(WayLog, WallsOfBeforeTheBeginningAreLeftOut) {
  WayLog log = Begun();
  log.OnFeature(Seen(1, -5, WallAt(3, 3, 0, 2)));
  EXPECT_TRUE(log.way().pieces.empty());
  log.OnFeature(Seen(1, 4, WallAt(3, 3, 0, 2)));
  EXPECT_EQ(log.way().pieces.size(), 1U);
}

TEST(WayLog, WallsOfBeforeAPoseWasSetAreLeftOutAndThoseAfterItMoved) {
  WayLog log = Begun();
  log.OnPose(At(10), {11, 12, kPi / 2}, At(9));
  log.OnFeature(Seen(1, 5, WallAt(3, 3, 0, 2)));
  EXPECT_TRUE(log.way().pieces.empty());
  log.OnFeature(Seen(2, 12, WallAt(13, 13, 0, 2)));
  ASSERT_EQ(log.way().pieces.size(), 1U);
  EXPECT_NEAR(log.way().pieces[0].way_from_middle.x, 3, 1e-9);
}

TEST(WayLog, AWallThatGrowsIsOneAndOneThatIsGoneIsNone) {
  WayLog log = Begun();
  log.OnFeature(Seen(1, 5, WallAt(3, 3, 0, 1)));
  log.OnFeature(Seen(1, 9, WallAt(3.5, 3, 0, 2)));
  ASSERT_EQ(log.way().pieces.size(), 1U);
  EXPECT_EQ(log.way().pieces[0].length_m, 2);
  log.OnFeature({1, 1});
  EXPECT_TRUE(log.way().pieces.empty());
}

TEST(WayLog, TwoNumbersOfOneWallAreOnePiece) {
  WayLog log = Begun();
  log.OnFeature(Seen(1, 5, WallAt(3, 3, 0, 1)));
  log.OnFeature(Seen(2, 6, WallAt(3.4, 3.05, 1, 2)));
  log.OnFeature(Seen(3, 6, WallAt(3.4, 4, 0, 2)));
  EXPECT_EQ(log.way().pieces.size(), 2U);
}

}  // namespace
}  // namespace priamos::planner
