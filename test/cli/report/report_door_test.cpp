#include "cli/report/report_door.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

/// A door of the plan at (6, 2.4) that was built 10 cm behind it and turned by a right angle.
RunInfo Displaced() {
  RunInfo info;
  info.door.emplace();
  info.door->id = 3;
  info.door->x_m = 6;
  info.door->y_m = 2.4;
  info.world.doors = {*info.door};
  info.world.doors[0].x_m = 6.1;
  info.world.doors[0].yaw_deg = 90;
  return info;
}

TEST(ReportDoor, IsTheOneThatWasBuilt) {
  EXPECT_EQ(BuiltDoor(Displaced())->x_m, 6.1);
  RunInfo without = Displaced();
  without.world.doors.clear();
  EXPECT_EQ(BuiltDoor(without)->x_m, 6);
}

TEST(ReportDoor, OnThePlanTheTruthIsAtTheDoorAsInTheWorld) {
  RunRecord record;
  record.truth.emplace_back();
  record.truth[0].x_m = 6.1;
  record.truth[0].y_m = 1.4;  // 1 m before the door as built
  record.truth[0].yaw_rad = Radians(90);
  const RunRecord dut = OnPlan(record, Displaced());
  EXPECT_NEAR(dut.truth[0].x_m, 5, 1e-12);
  EXPECT_NEAR(dut.truth[0].y_m, 2.4, 1e-12);
  EXPECT_NEAR(dut.truth[0].yaw_rad, 0, 1e-12);
}

}  // namespace
}  // namespace priamos::cli
