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
  const auto dut = Dut().Nearest(place, {Turned(place)}, {});
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->door.id, 1);
  const Pose2 there = dut->door.map_from_door().Inverse() * dut->path.points.back();
  EXPECT_LT(there.x, -1.2);
  EXPECT_LT(std::abs(there.y), 0.5);
}

TEST(DoorViews, FromTheOtherRoomItIsSeenFromBehind) {
  const auto dut = Dut().Nearest({8.5, 2.4, 0}, {}, {});
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->door.id, 101);
}

TEST(DoorViews, ADoorThatIsThereFromBothPlacesTellsNothing) {
  const Pose2 place{2, 2.4, 0};
  EXPECT_FALSE(Dut().Nearest(place, {{2.3, 2.5, 0.1}}, {}));
}

TEST(DoorViews, ADoorThatWasLookedAtIsLeftOut) {
  EXPECT_FALSE(Dut().Nearest({2, 2.4, 0}, {}, {1}));
}

}  // namespace
}  // namespace priamos::planner
