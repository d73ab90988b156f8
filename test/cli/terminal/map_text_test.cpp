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

}  // namespace
}  // namespace priamos::cli
