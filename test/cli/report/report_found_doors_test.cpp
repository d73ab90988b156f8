#include "cli/report/report_found_doors.hpp"

#include <gtest/gtest.h>

#include "test/cli/report/driven_record.hpp"
#include "world/core/scene/build_solids.hpp"

namespace priamos::cli {
namespace {

RunRecord Drive() {
  RunRecord record = DriveAlongX(0.05);
  mission_command_t order{};
  order.utime = 1'000'000;
  order.mission = mission_command_t::CORRIDOR;
  record.orders.push_back(order);
  return record;
}

/// Three doors in the wall to the left: closed, ajar and open; and one far from the way.
RunInfo Corridor() {
  RunInfo info;
  const double open_deg[] = {0, 20, 90, 0};
  for (int i = 0; i < 4; ++i) {
    DoorPlan door;
    door.id = i + 1;
    door.name = std::string(1, static_cast<char>('a' + i));
    door.x_m = 2 + 2.0 * i;
    door.y_m = i < 3 ? 1.2 : 8;
    door.yaw_deg = 90;
    info.world.doors.push_back(door);
    world::DoorWork work;
    work.id = door.id;
    work.hinge = "left";
    for (const world::Solid& solid : world::DoorSolids(door, work, open_deg[i]))
      info.world.solids.push_back(solid);
  }
  return info;
}

door_found_t Told(const DoorPlan& door, double along_m, int state) {
  door_found_t told{};
  told.utime_seen = 3'000'000;
  const Pose2 at = Pose2{0, 0.05, 0} * door.map_from_door() * Pose2{door.FrontX(), along_m, 0};
  told.x_m = at.x;
  told.y_m = at.y;
  told.yaw_rad = at.yaw;
  told.width_m = 0.9;
  told.sigma_along_m = told.sigma_across_m = 0.02;
  told.state = static_cast<std::int8_t>(state);
  told.looks = 2;
  return told;
}

TEST(ReportFoundDoors, DoorsAreJudgedFromWhereTheRobotBelievedToBe) {
  RunRecord record = Drive();
  const RunInfo info = Corridor();
  record.doors.push_back(Told(info.world.doors[0], 0.03, door_found_t::CLOSED));
  record.doors.push_back(Told(info.world.doors[2], -0.01, door_found_t::AJAR));
  DoorPlan nowhere = info.world.doors[0];
  nowhere.x_m = 9.5;
  record.doors.push_back(Told(nowhere, 0, door_found_t::OPEN));
  const auto dut = FoundDoorsOf(record, info);
  ASSERT_TRUE(dut);
  ASSERT_EQ(dut->on_the_way.size(), 3u) << "the fourth is no door of this corridor";
  EXPECT_EQ(dut->false_ones, 1);
  EXPECT_EQ(dut->on_the_way[0].state, "closed");
  EXPECT_EQ(dut->on_the_way[0].told, "closed");
  EXPECT_NEAR(dut->on_the_way[0].along_m, 0.03, 1e-6);
  EXPECT_NEAR(dut->on_the_way[0].across_m, 0, 1e-6);
  EXPECT_EQ(dut->on_the_way[1].state, "ajar");
  EXPECT_FALSE(dut->on_the_way[1].told);
  EXPECT_EQ(dut->on_the_way[2].state, "open");
  EXPECT_EQ(dut->on_the_way[2].told, "ajar");
}

TEST(ReportFoundDoors, OtherDrivesHaveNone) {
  RunRecord record = Drive();
  record.orders[0].mission = mission_command_t::GOTO;
  EXPECT_FALSE(FoundDoorsOf(record, Corridor()));
}

}  // namespace
}  // namespace priamos::cli
