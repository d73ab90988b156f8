#include "cli/terminal/map_text.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

TEST(DoorTable, ADoorHasItsNameItsStateAndItsAge) {
  LearnedWalls learned;
  LearnedDoor door;
  door.id = 3;
  door.x_m = 6;
  door.y_m = 1.1;
  door.state = "ajar";
  door.changed_s = 940;
  door.seen_s = 990;
  door.looks = 4;
  learned.doors = {door};
  const std::string unnamed = DoorTable({}, learned, 1000, std::nullopt);
  EXPECT_THAT(unnamed, testing::HasSubstr("door 3"));
  EXPECT_THAT(unnamed, testing::HasSubstr("ajar"));
  EXPECT_THAT(unnamed, testing::HasSubstr("60 s"));
  EXPECT_THAT(unnamed, testing::HasSubstr("10 s"));
  EXPECT_THAT(unnamed, testing::HasSubstr("4x"));
  GroundPlan plan;
  plan.doors.push_back({});
  plan.doors[0].name = "office";
  plan.doors[0].x_m = 6;
  plan.doors[0].y_m = 1.17;
  EXPECT_THAT(DoorTable(plan, learned, 1000, std::nullopt), testing::HasSubstr("door 'office'"));
}

TEST(PointTable, APointHasItsPlaceAndItsAge) {
  LearnedWalls learned;
  learned.points = {{6, 1.1, 0.013, 990, 7}};
  const std::string dut = PointTable(learned, 1000, std::nullopt);
  for (const char* words : {"point 7", "(6.00, 1.10)", "±1.3 cm", "10 s"})
    EXPECT_THAT(dut, testing::HasSubstr(words));
  learned.points.push_back({0, 0, 0.02, 990, 8});
  const std::string dots = MapDots({}, learned, {}, false);
  EXPECT_THAT(dots, testing::HasSubstr("⠗")) << dots;
  EXPECT_THAT(dots, testing::HasSubstr("⠋")) << "the other, at the edge of the picture\n" << dots;
}

TEST(ObjectTable, AThingHasItsPlaceItsSizeAndItsAge) {
  LearnedWalls learned;
  LearnedObject box;
  box.id = 3;
  box.kind = "box";
  box.x_m = 6;
  box.y_m = 1.1;
  box.width_m = 0.6;
  box.depth_m = 0.4;
  box.top_m = 1.15;
  box.sigma_across_m = 0.013;
  box.seen_s = 990;
  box.looks = 4;
  learned.objects = {box};
  const std::string dut = ObjectTable(learned, 1000, std::nullopt);
  for (const char* words :
       {"thing 3", "(6.00, 1.10)", "box", "0.60 x 0.40 m", "1.15 m", "±1.3 cm", "4x", "10 s"})
    EXPECT_THAT(dut, testing::HasSubstr(words));
  EXPECT_THAT(MapDots({}, learned, {}, true), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace priamos::cli
