#include "planner/core/map/learned_obstacles.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// Of the shipped plan: a room from x 0 to 6, y 0 to 4.8.
std::vector<NamedObstacle> Of(const LearnedWall& wall) {
  LearnedWalls learned;
  learned.walls = {wall};
  return ObstaclesOf(learned, ObstacleMap(ShippedPlan()), ShippedPlan().doors);
}

std::vector<NamedObstacle> Of(const LearnedObject& object, std::vector<LearnedDoor> doors = {}) {
  LearnedWalls learned;
  learned.objects = {object};
  learned.doors = std::move(doors);
  return ObstaclesOf(learned, ObstacleMap(ShippedPlan()), ShippedPlan().doors);
}

TEST(ObstaclesOf, AWallThatIsNotOnThePlanIsOne) {
  const auto dut = Of(WallAt(3, 2.4, 90, 1.5));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].name, "learned wall 1");
  EXPECT_NEAR(dut[0].shape.half_m.x(), 0.75, 0.01);
  // It was heard from the left of its direction, from -x; it stands behind the face that was heard.
  EXPECT_NEAR(dut[0].shape.map_from_centre.x, 3.02, 1e-6);
}

TEST(ObstaclesOf, AWallOfThePlanThatWasHeardIsNone) {
  EXPECT_THAT(Of(WallAt(3, 0.05, 0, 3)), IsEmpty());
  EXPECT_THAT(Of(WallAt(3, 0.15, 0, 3)), IsEmpty()) << "people measure to a few centimetres";
}

TEST(ObstaclesOf, WhatIsPartlyOnThePlanIsOneWhereItIsNot) {
  const auto dut = Of(WallAt(3, 0.9, 90, 2));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_LT(dut[0].shape.half_m.x(), 0.9);
  EXPECT_GT(dut[0].shape.half_m.x(), 0.7);
}

TEST(ObstaclesOf, WhatIsHardlyKnownIsNone) {
  LearnedWall vague = WallAt(3, 2.4, 90, 1.5);
  vague.sigma_across_m = 0.2;
  EXPECT_THAT(Of(vague), IsEmpty());
  vague.sigma_across_m = 0.02;
  vague.sigma_yaw_deg = 15;
  const auto dut = Of(vague);
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_LT(dut[0].shape.half_m.x(), 0.65) << "its middle only";
}

TEST(ObstaclesOf, ABoxThatTheHeadSawIsOneWithItsSizeInItsName) {
  const auto dut = Of(BoxAt(3, 2.4, 90));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].name, "thing 3, 0.60 x 0.40 m, seen by the head");
  EXPECT_NEAR(dut[0].shape.map_from_centre.x, 3, 1e-9);
  EXPECT_NEAR(dut[0].shape.map_from_centre.y, 2.6, 1e-9);
  EXPECT_NEAR(dut[0].shape.half_m.x(), 0.2 + 0.02, 1e-9) << "larger by one sigma";
  EXPECT_NEAR(dut[0].shape.half_m.y(), 0.3 + 0.03, 1e-9);
}

TEST(ObstaclesOf, AThingOfAnyWidthIsOne) {
  for (int cm = 2; cm <= 178; cm += 2) {
    LearnedObject box = BoxAt(3, 2.4, 90);
    box.width_m = cm / 100.0;
    EXPECT_THAT(Of(box), SizeIs(1)) << cm << " cm";
  }
}

TEST(ObstaclesOf, WhatIsToldFarFromTheBuildingIsNothing) {
  EXPECT_THAT(Of(BoxAt(-100, -100, 90)), IsEmpty());
  EXPECT_THAT(Of(BoxAt(-3, 2.4, 90)), SizeIs(1)) << "before its door";
}

TEST(ObstaclesOf, AFaceIsFiveCentimetresDeepAndAnEdgeIsNothing) {
  LearnedObject object = BoxAt(3, 2.4, 90);
  object.kind = "face";
  object.depth_m = 0;
  const auto dut = Of(object);
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].name, "thing 3, 0.60 m wide, seen by the head");
  EXPECT_NEAR(dut[0].shape.map_from_centre.y, 2.425, 1e-9);
  EXPECT_NEAR(dut[0].shape.half_m.x(), 0.025 + 0.02, 1e-9);
  object.kind = "edge";
  object.width_m = 0;
  EXPECT_THAT(Of(object), IsEmpty());
}

TEST(ObstaclesOf, TheTopOfATableIsOneAndWhatHangsAtAWallOrOverADoorIsNone) {
  LearnedObject top = BoxAt(3, 2.4, 90);
  top.bottom_m = 0.67;
  top.top_m = 0.72;
  EXPECT_THAT(Of(top), SizeIs(1));
  LearnedObject border = top;
  border.kind = "face";
  border.depth_m = 0;
  EXPECT_THAT(Of(border), SizeIs(1));
  LearnedObject picture = border;
  picture.x_m = 5.92;
  picture.y_m = 0.9;
  picture.yaw_deg = 0;
  EXPECT_THAT(Of(picture), IsEmpty()) << "its lower border, on the wall beside the door";
  LearnedObject lintel = border;
  lintel.x_m = 5.92;
  lintel.yaw_deg = 0;
  lintel.bottom_m = 1.3;
  lintel.top_m = 1.35;
  EXPECT_THAT(Of(lintel), IsEmpty()) << "no door is closed by what hangs over it";
}

TEST(ObstaclesOf, ThingsThatAreHardlyKnownOrNotInTheWayAreNone) {
  const auto counts = [](const auto& change) {
    LearnedObject object = BoxAt(3, 2.4, 90);
    change(object);
    return !Of(object).empty();
  };
  EXPECT_FALSE(counts([](LearnedObject& o) { o.looks = 1; }));
  EXPECT_FALSE(counts([](LearnedObject& o) { o.sigma_across_m = 0.16; }));
  EXPECT_FALSE(counts([](LearnedObject& o) { o.sigma_along_m = 0.16; }));
  EXPECT_FALSE(counts([](LearnedObject& o) { o.bottom_m = 1.65, o.top_m = 1.9; })) << "a shelf on a wall";
  EXPECT_FALSE(counts([](LearnedObject& o) { o.top_m = 0.02; })) << "the border of a carpet";
  EXPECT_TRUE(counts([](LearnedObject& o) { o.bottom_m = 0.7; })) << "a table";
}

TEST(ObstaclesOf, AThingThatLiesOnThePlanIsThat) {
  EXPECT_THAT(Of(BoxAt(3, 0.05, -90)), IsEmpty()) << "the south wall";
  EXPECT_THAT(Of(BoxAt(3, 0.5, -90)), SizeIs(1)) << "a cupboard before it";
  LearnedObject across = BoxAt(3, 0.4, 0);  // from y -0.6 to 1.4: its greater part is in the room
  across.width_m = 2;
  EXPECT_THAT(Of(across), SizeIs(1));
}

TEST(ObstaclesOf, NothingAtADoorOfThePlanClosesIt) {
  const Pose2 door = ShippedPlan().doors[0].map_from_door();
  const auto at = [&](const Pose2& in_door, const char* kind) {
    const Pose2 there = door * in_door;
    LearnedObject object = BoxAt(there.x, there.y, Degrees(there.yaw));
    object.kind = kind;
    object.width_m = 0.9;
    return Of(object).size();
  };
  EXPECT_EQ(at({0, 0, 0}, "face"), 0u) << "a closed leaf";
  EXPECT_EQ(at({-0.3, 0.6, 0}, "box"), 0u) << "a jamb";
  EXPECT_EQ(at({0.55, -0.5, kPi / 2}, "face"), 0u) << "a leaf that stands open";
  EXPECT_EQ(at({-0.55, 0.45, kPi / 2}, "face"), 0u) << "to the other side";
  EXPECT_EQ(at({-1.6, 0, 0}, "box"), 1u) << "what stands before it is in the way";
}

TEST(ObstaclesOf, NorAtALearnedDoor) {
  LearnedDoor door;
  door.x_m = 3;
  door.y_m = 2.4;
  door.yaw_deg = 90;
  EXPECT_THAT(Of(BoxAt(3, 2.4, 90), {door}), IsEmpty());
  EXPECT_THAT(Of(BoxAt(3.6, 2.4, 90), {door}), IsEmpty()) << "its jamb";
  EXPECT_THAT(Of(BoxAt(3, 0.8, 90), {door}), SizeIs(1));
}

}  // namespace
}  // namespace priamos::planner
