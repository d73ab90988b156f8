#include "common/learned/object_book.hpp"

#include <gmock/gmock.h>

namespace priamos {
namespace {

using testing::SizeIs;

LearnedObject Told(const char* kind, double x_m, double y_m, double yaw_deg = 0, double seen_s = 100,
                   int looks = 2) {
  LearnedObject object;
  object.kind = kind;
  object.x_m = x_m;
  object.y_m = y_m;
  object.yaw_deg = yaw_deg;
  if (object.kind != "edge") object.width_m = 0.6;
  if (object.kind == "box") object.depth_m = 0.4;
  object.top_m = 1.1;
  object.seen_s = seen_s;
  object.looks = looks;
  return object;
}

TEST(LearnedObject, CoversWhatIsBehindItsFront) {
  const Rectangle box = Told("box", 2, 1, 90).Footprint();
  EXPECT_NEAR(box.map_from_centre.x, 2, 1e-9);
  EXPECT_NEAR(box.map_from_centre.y, 1.2, 1e-9);
  EXPECT_EQ(box.half_m, Eigen::Vector2d(0.2, 0.3));
  const Rectangle face = Told("face", 2, 1, 180).Footprint();
  EXPECT_NEAR(face.map_from_centre.x, 1.975, 1e-9);
  EXPECT_EQ(face.half_m, Eigen::Vector2d(0.025, 0.3));
  EXPECT_EQ(Told("edge", 2, 1).Footprint().half_m, Eigen::Vector2d(0, 0));
}

TEST(LearnedObject, SaysItsSize) {
  LearnedObject dut = Told("box", 2, 1);
  dut.id = 3;
  EXPECT_EQ(NameOf(dut), "thing 3");
  EXPECT_EQ(SizeOf(dut), "0.60 x 0.40 m");
  EXPECT_EQ(SizeOf(Told("face", 2, 1)), "0.60 m wide");
  EXPECT_EQ(SizeOf(Told("edge", 2, 1)), "an edge");
}

TEST(ObjectBook, ThingsAreKnownByTheirPlace) {
  LearnedWalls map;
  EXPECT_TRUE(EnterObject(Told("box", 2, 1), map));
  EXPECT_TRUE(EnterObject(Told("box", 4, 1), map));
  LearnedObject again = Told("box", 2.1, 1.05, 5, 110, 3);
  again.id = 77;  // of another head
  EXPECT_TRUE(EnterObject(again, map));
  ASSERT_THAT(map.objects, SizeIs(2));
  EXPECT_EQ(map.objects.back().id, 1);
  EXPECT_EQ(map.objects.back().x_m, 2.1);
  EXPECT_EQ(map.objects.back().looks, 3);
  EXPECT_EQ(map.revision, 3);
}

TEST(ObjectBook, WhatAHeadTellsElsewhereUnderItsNumberHasMoved) {
  LearnedWalls map;
  LearnedObject thing = Told("box", 2, 1, 0, 100, 2);
  thing.told_id = 7;
  EnterObject(thing, map);
  LearnedObject fewer = Told("box", 4, 1, 0, 300, 2);  // of a head that began anew
  fewer.told_id = 7;
  EnterObject(fewer, map);
  EXPECT_THAT(map.objects, SizeIs(2));
  map.objects.pop_back();
  LearnedObject corrected = Told("box", 2.1, 1.2, 0, 100, 2);
  corrected.told_id = 7;
  EXPECT_TRUE(EnterObject(corrected, map)) << "no look since, but the pose was corrected";
  LearnedObject moved = Told("box", 2.6, 1.5, 0, 320, 5);
  moved.told_id = 7;
  EnterObject(moved, map);
  ASSERT_THAT(map.objects, SizeIs(1));
  EXPECT_EQ(map.objects[0].x_m, 2.6);
}

TEST(ObjectBook, WhatHasGoneIsTakenAway) {
  LearnedWalls map;
  EnterObject(Told("box", 2, 1), map);
  EnterObject(Told("box", 4, 1), map);
  EXPECT_FALSE(EnterObject(Told("face", 6, 1, 0, 120, 0), map)) << "nothing stood there";
  EXPECT_FALSE(EnterObject(Told("face", 2, 1, 0, 50, 0), map)) << "it was seen later";
  EXPECT_TRUE(EnterObject(Told("face", 2, 1, 0, 120, 0), map));
  ASSERT_THAT(map.objects, SizeIs(1));
  EXPECT_EQ(map.objects[0].x_m, 4);
  EXPECT_EQ(map.revision, 3);
}

TEST(ObjectBook, WhatIsToldAgainChangesNothing) {
  LearnedWalls map;
  EnterObject(Told("face", 2, 1), map);
  EXPECT_FALSE(EnterObject(Told("face", 2, 1, 0, 100.6), map)) << "times travel in seconds";
  EXPECT_FALSE(EnterObject(Told("face", 2, 1, 0, 60, 5), map)) << "from before";
  EXPECT_EQ(map.revision, 1);
}

TEST(ObjectBook, AnotherSideOfABoxIsTheBox) {
  EXPECT_TRUE(AreOne(Told("box", 2, 1), Told("box", 2.2, 0.7, 90))) << "two fronts, 36 cm apart, one inside";
  EXPECT_TRUE(AreOne(Told("face", 2, 1), Told("face", 2.03, 1.1, 180))) << "a board from behind";
  EXPECT_TRUE(AreOne(Told("face", 2, 1), Told("face", 2.2, 1, 20)));
  EXPECT_FALSE(AreOne(Told("face", 2, 1), Told("face", 2.2, 1.1, 45))) << "near, but askew";
  EXPECT_FALSE(AreOne(Told("box", 2, 1), Told("box", 2, 1.62))) << "side by side";
}

TEST(ObjectBook, WhatStandsAboveIsAnotherThing) {
  LearnedObject shelf = Told("box", 2, 1);
  shelf.bottom_m = 1.5;
  shelf.top_m = 1.9;
  EXPECT_FALSE(AreOne(Told("box", 2, 1), shelf));
  EXPECT_FALSE(AreOne(shelf, Told("box", 2, 1)));
}

TEST(ObjectBook, AFaceTakesItsEdgesInAndABoxItsFaces) {
  LearnedWalls map;
  EnterObject(Told("edge", 2, 0.7), map);
  EnterObject(Told("edge", 2, 1.3), map);
  ASSERT_THAT(map.objects, SizeIs(2));
  EnterObject(Told("face", 2, 1, 0, 110), map);
  ASSERT_THAT(map.objects, SizeIs(1));
  EXPECT_EQ(map.objects[0].kind, "face");
  EnterObject(Told("box", 2, 1, 0, 120), map);
  ASSERT_THAT(map.objects, SizeIs(1));
  EXPECT_EQ(map.objects[0].kind, "box");
  EXPECT_EQ(map.objects[0].id, 1);
}

TEST(ObjectBook, WhatTellsLessDoesNotTakeTurnsWithWhatTellsMore) {
  LearnedWalls map;
  EnterObject(Told("box", 2, 1), map);
  EXPECT_FALSE(EnterObject(Told("face", 2.2, 0.7, 90, 130, 9), map)) << "one of its sides";
  EXPECT_FALSE(EnterObject(Told("edge", 2, 1.3, 0, 130, 9), map));
  EXPECT_FALSE(EnterObject(Told("box", 2, 1, 0, 130, 1), map)) << "a head that has just begun";
  EXPECT_TRUE(EnterObject(Told("face", 2, 1, 0, 800), map)) << "the box was not seen for long";
  EXPECT_EQ(map.objects[0].kind, "face");
}

TEST(ObjectBook, OfTooManyTheOldestGoes) {
  LearnedWalls map;
  for (std::size_t i = 0; i <= kMostObjects; ++i)
    EnterObject(Told("box", 2.0 * double(i), 1, 0, 1000 + double(i)), map);
  EXPECT_THAT(map.objects, SizeIs(kMostObjects));
  EXPECT_EQ(map.objects[0].x_m, 2);
}

}  // namespace
}  // namespace priamos
