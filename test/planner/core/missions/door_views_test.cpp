#include "planner/core/missions/door_views.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

/// The same place of the first room of the shipped plan, half a turn farther.
Pose2 Turned(const Pose2& place) {
  return Pose2{5.93, 4.8, kPi} * place;
}

DoorViews Dut() {
  return {{}, {}, ShippedPlan()};
}

TEST(DoorViews, ADoorTellsTheEndsOfARoomApart) {
  const Pose2 place{2, 2.4, 0};
  const auto dut = Dut().Best({place}, {Turned(place)}, {});
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->door.id, 1);
  const Pose2 there = dut->door.map_from_door().Inverse() * dut->path.points.back();
  EXPECT_LT(there.x, -1.2);
  EXPECT_LT(std::abs(there.y), 0.5);
}

TEST(DoorViews, FromTheOtherRoomItIsSeenFromBehind) {
  const auto dut = Dut().Best({{8.5, 2.4, 0}}, {}, {});
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->door.id, 101);
}

TEST(DoorViews, ADoorThatIsThereFromBothPlacesTellsNothing) {
  const Pose2 place{2, 2.4, 0};
  EXPECT_FALSE(Dut().Best({place}, {{2.3, 2.5, 0.1}}, {}));
}

TEST(DoorViews, OneThatTellsSomeOfThePlacesApartIsWorthALook) {
  const Pose2 place{2, 2.4, 0};
  EXPECT_TRUE(Dut().Best({place}, {{2.3, 2.5, 0.1}, Turned(place)}, {}));
}

TEST(DoorViews, AViewThatIsSpentIsLeftOutAndTheNextIsFromElsewhere) {
  const Pose2 place{2, 2.4, 0};
  const DoorViews dut = Dut();
  std::vector<SpentView> spent;
  for (int i = 0; i < 4; ++i) {
    const auto view = dut.Best({place}, {}, spent);
    ASSERT_TRUE(view) << i;
    for (const SpentView& before : spent)
      EXPECT_GT((view->door_from_base.translation() - before.door_from_base.translation()).norm(), 0.49);
    spent.push_back({view->door.id, view->door_from_base});
  }
}

TEST(DoorViews, WhoSeesTheDoorNeedNotDrive) {
  const auto dut = Dut().Best({{1, 2.4, 0}, {4, 2.4, 0.1}}, {}, {});
  ASSERT_TRUE(dut);
  EXPECT_TRUE(dut->path.points.empty());
}

TEST(DoorViews, WhatWasHeardBeforeTheDoorIsLookedPast) {
  LearnedWall screen;
  screen.x_m = 5;
  screen.y_m = 2.0;
  screen.yaw_deg = 90;
  screen.length_m = 1.2;
  DoorViews dut = Dut();
  const Pose2 place{3, 2.4, 0};
  dut.Know({.walls = {screen}, .doors = {}}, {}, {}, place);
  const auto view = dut.Best({place}, {}, {});
  ASSERT_TRUE(view);
  const Eigen::Vector2d from = (view->door.map_from_door() * view->door_from_base).translation();
  // The line to the right jamb, at the screen.
  const double part = (5 - from.x()) / (5.75 - from.x());
  const double at_m = from.y() + part * (1.95 - from.y());
  EXPECT_TRUE(from.x() > 5 || at_m > 2.6 || at_m < 1.4) << from.transpose();
}

/// A room in which a thing closes the way that the base came: where it was it can be again.
TEST(DoorViews, ThePlaceFromWhichItCameIsReachedAsItCame) {
  DoorViews dut = Dut();
  const std::vector<Pose2> trail{{4, 2.4, 0}, {3, 2.4, 0}, {2, 2.4, 0}, {1, 2.4, 0}};
  dut.Know({}, {{{2.2, 2.4, 0}, {0.2, 2.4}}}, {}, trail.back());
  const auto view = dut.Best(trail, {}, {});
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->path.points.back().y, 2.4, 1e-6);
  EXPECT_GT(view->path.points.back().x, 2.9);
}

TEST(DoorViews, AWallOfThePlanHidesADoor) {
  GroundPlan plan = ShippedPlan();
  WallPlan wall;
  wall.from_m = {5.4, 0};
  wall.to_m = {5.4, 4.8};
  plan.walls.push_back(wall);
  EXPECT_FALSE(DoorViews({}, {}, plan).Best({{3, 2.4, 0}}, {}, {}));
}

TEST(DoorViews, TheOtherSideOfADoorLooksDifferent) {
  const Pose2 place{4, 2.4, 0};
  // The same place before the door, from behind.
  const Pose2 behind = Pose2{6, 2.4, kPi} * Pose2{6, 2.4, 0}.Inverse() * place;
  EXPECT_FALSE(Dut().Best({place}, {behind}, {}));
  const auto dut = Dut().Best({place}, {behind}, {}, DoorViews::Sides::kDiffer);
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->door.id, 1);
  EXPECT_EQ(Dut().Here(behind, {place}, {}, DoorViews::Sides::kDiffer)->door.id, 101);
}

TEST(DoorViews, FromHereIsOnlyWhatIsInSightAsTheBaseStands) {
  EXPECT_TRUE(Dut().Here({4, 2.4, 0}, {}, {}));
  EXPECT_FALSE(Dut().Here({4, 2.4, kPi}, {}, {}));
  EXPECT_FALSE(Dut().Here({1, 2.4, 0}, {}, {}));
  EXPECT_FALSE(Dut().Here({4, 2.4, 0}, {}, {{1, {-2, 0, 0}}}));
}

TEST(DoorViews, NoWayLeadsOverWhatWasHeardNear) {
  DoorViews dut = Dut();
  const Pose2 place{1, 2.4, 0};
  const auto before = dut.Best({place}, {}, {});
  ASSERT_TRUE(before);
  const Rectangle echo{{before->path.points.back().x, 2.4, 0}, {0.1, 0.1}};
  dut.Know({}, {}, {echo}, place);
  const auto after = dut.Best({place}, {}, {});
  ASSERT_TRUE(after);
  const Rectangle base{after->path.points.back(), {0.475, 0.39}};
  EXPECT_GT(Distance(echo, base), 0.09);
}

TEST(DoorViews, AfterAViewFromOneSideTheNextIsFromTheOther) {
  const Pose2 place{4, 3.4, -1};
  const DoorViews dut = Dut();
  const auto view = dut.Best({place}, {}, {{1, {-1.6, 1.2, 0}}, {1, {-2.2, 0.8, 0}}});
  ASSERT_TRUE(view);
  EXPECT_LT(view->door_from_base.y, 0.1);
}

}  // namespace
}  // namespace priamos::planner
