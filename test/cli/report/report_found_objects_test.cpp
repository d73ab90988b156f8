#include "cli/report/report_found_objects.hpp"

#include <gtest/gtest.h>

#include "test/cli/report/driven_record.hpp"

namespace priamos::cli {
namespace {

RunRecord Drive() {
  return DriveAlongX(0.2);
}

/// A box of 0.4 x 0.6 m and 0.5 m height with its middle at (4, 1).
RunInfo Room() {
  RunInfo info;
  info.world.solids = {{"box", {4, 1, 0}, {0.4, 0.6}, 0, 0.5, "wood"}};
  return info;
}

/// In the robot's map.
scene_object_t Told(int kind, double x_m, double y_m, double yaw_rad) {
  scene_object_t told{};
  told.utime_seen = 3'000'000;
  told.kind = static_cast<std::int8_t>(kind);
  told.x_m = x_m;
  told.y_m = y_m;
  told.yaw_rad = yaw_rad;
  if (kind != scene_object_t::EDGE) told.width_m = 0.6;
  if (kind == scene_object_t::BOX) told.depth_m = 0.4;
  told.top_m = 0.5;
  told.looks = 2;
  return told;
}

TEST(ReportFoundObjects, FrontsAreJudgedFromWhereTheRobotBelievedToBe) {
  RunRecord record = Drive();
  record.objects.push_back(Told(scene_object_t::BOX, 3.82, 1.2, 0));  // 2 cm before its true front
  record.objects.push_back(Told(scene_object_t::FACE, 7, 1.2, 0));
  const auto dut = FoundObjectsOf(record, Room());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->told(), 2);
  EXPECT_EQ(dut->boxes, 1);
  EXPECT_EQ(dut->faces, 1);
  EXPECT_EQ(dut->standing, 1);
  EXPECT_EQ(dut->phantoms, 1);
  EXPECT_NEAR(dut->front_p95_m, 2.8, 0.01) << "of the phantom";
  record.objects.pop_back();
  EXPECT_NEAR(FoundObjectsOf(record, Room())->front_p95_m, 0.02, 1e-6);
}

TEST(ReportFoundObjects, WhatLiesInsideOrAboveIsNoSurfaceOfIt) {
  RunRecord record = Drive();
  record.objects.push_back(Told(scene_object_t::EDGE, 4, 1.2, 0));
  EXPECT_NEAR(FoundObjectsOf(record, Room())->front_p95_m, 0.2, 1e-6) << "in the middle of the box";
  record.objects[0] = Told(scene_object_t::EDGE, 3.8, 0.9, 0);
  EXPECT_EQ(FoundObjectsOf(record, Room())->standing, 1) << "at its corner";
  record.objects[0].bottom_m = 0.9;
  record.objects[0].top_m = 1.5;
  EXPECT_EQ(FoundObjectsOf(record, Room())->phantoms, 1);
}

TEST(ReportFoundObjects, AFrontOfWhichLittleIsThereIsNeither) {
  RunRecord record = Drive();
  scene_object_t wide = Told(scene_object_t::FACE, 3.8, 2.1, 0);  // true y from 0.9 to 2.9
  wide.width_m = 2;
  record.objects.push_back(wide);
  const auto dut = FoundObjectsOf(record, Room());
  EXPECT_EQ(dut->standing, 0);
  EXPECT_EQ(dut->phantoms, 0);
}

TEST(ReportFoundObjects, WhatIsToldAgainCountsOnceAndDamagedOnesNever) {
  RunRecord record = Drive();
  record.objects = {Told(scene_object_t::BOX, 3.8, 1.2, 0), Told(scene_object_t::BOX, 3.8, 1.2, 0)};
  record.objects[1].utime_seen = 9'000'000;
  record.objects.push_back(Told(5, 9, 1, 0));
  EXPECT_EQ(FoundObjectsOf(record, Room())->told(), 1);
  record.objects.clear();
  EXPECT_FALSE(FoundObjectsOf(record, Room()));
}

}  // namespace
}  // namespace priamos::cli
