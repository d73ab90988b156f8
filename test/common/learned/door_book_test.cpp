#include "common/learned/door_book.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

LearnedDoor Told(double x_m, const char* state, double seen_s, int looks = 2) {
  LearnedDoor door;
  door.x_m = x_m;
  door.y_m = 1;
  door.yaw_deg = 90;
  door.state = state;
  door.seen_s = seen_s;
  door.looks = looks;
  return door;
}

TEST(DoorBook, DoorsAreKnownByTheirPlace) {
  LearnedWalls map;
  EXPECT_TRUE(EnterDoor(Told(2, "closed", 100), map));
  EXPECT_TRUE(EnterDoor(Told(2.2, "closed", 110, 3), map)) << "the same, seen again";
  EXPECT_TRUE(EnterDoor(Told(4, "open", 120), map));
  ASSERT_EQ(map.doors.size(), 2u);
  EXPECT_EQ(map.doors[0].id, 1);
  EXPECT_EQ(map.doors[1].id, 2);
  EXPECT_EQ(map.doors[0].x_m, 2.2);
  EXPECT_EQ(map.revision, 3);
}

TEST(DoorBook, WhatIsToldAgainChangesNothing) {
  LearnedWalls map;
  EnterDoor(Told(2, "closed", 100), map);
  EXPECT_FALSE(EnterDoor(Told(2, "closed", 100.6), map)) << "times travel in seconds";
  EXPECT_FALSE(EnterDoor(Told(2, "open", 60), map)) << "from before";
  EXPECT_EQ(map.revision, 1);
}

TEST(DoorBook, AChangeOfStateHasItsTime) {
  LearnedWalls map;
  EnterDoor(Told(2, "closed", 100), map);
  EXPECT_EQ(map.doors[0].changed_s, 0);
  EnterDoor(Told(2, "open", 200, 4), map);
  EXPECT_EQ(map.doors[0].state, "open");
  EXPECT_EQ(map.doors[0].changed_s, 200);
  EnterDoor(Told(2, "unknown", 300, 5), map);
  EXPECT_EQ(map.doors[0].state, "open") << "a look that shows no leaf changes nothing";
  EXPECT_EQ(map.doors[0].changed_s, 200);
  EXPECT_EQ(map.doors[0].seen_s, 300);
}

TEST(DoorBook, SaysWhatWasOnTheWay) {
  LearnedWalls map;
  EXPECT_EQ(DoorsSeenSince(map, 0), "");
  EnterDoor(Told(2, "closed", 100), map);
  EXPECT_EQ(DoorsSeenSince(map, 50), "1 door on the way: 1 closed");
  EnterDoor(Told(4, "open", 120), map);
  EnterDoor(Told(6, "closed", 130), map);
  EXPECT_EQ(DoorsSeenSince(map, 50), "3 doors on the way: 2 closed, 1 open");
  EXPECT_EQ(DoorsSeenSince(map, 110), "2 doors on the way: 1 closed, 1 open");
}

}  // namespace
}  // namespace priamos
