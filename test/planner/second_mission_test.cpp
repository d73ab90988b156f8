// A second mission joins the planner by a line of the table: its orders, reports and outcome cross the bus
// while planner_app stays as it is.
#include <gmock/gmock.h>

#include <memory>

#include "test/planner/core/missions/drive_ahead_mission.hpp"
#include "workstation.hpp"

namespace priamos::planner {
namespace {

constexpr std::int8_t kDriveAhead = 6;

MissionTable WithDriveAhead(const PlannerConfig& config, const GroundPlan& plan) {
  MissionTable missions = MakeMissions(config, plan);
  missions.Add(kDriveAhead, std::make_unique<DriveAheadMission>());
  return missions;
}

/// Runs the second mission until its path was ordered, which is returned.
path_t DriveAhead(Workstation& w) {
  w.Order(kDriveAhead, 3);
  w.SendPose(2.0);
  w.Run(2);
  const auto looks = w.looks.Drain();
  if (looks.size() != 1 || looks[0].landmark_id != 3) return {};
  w.SendCorrection(looks[0].request_id);
  w.Run(2);
  const auto paths = w.paths.Drain();
  return paths.size() == 1 ? paths[0] : path_t{};
}

TEST(SecondMission, IsCarriedOutOnTheBus) {
  Workstation w({}, WithDriveAhead);
  const path_t path = DriveAhead(w);
  ASSERT_EQ(path.n_points, 1);
  EXPECT_NEAR(path.points[0].x_m, 3.0, 1e-9);
  EXPECT_EQ(w.phase(), mission_status_t::PASSING);
  w.SendDrive(path.path_id, drive_status_t::ARRIVED);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::DONE);
  EXPECT_EQ(w.last_status.mission, kDriveAhead);
  EXPECT_EQ(w.last_status.text, "1 m ahead");
}

TEST(SecondMission, AbortBrakesIt) {
  Workstation w({}, WithDriveAhead);
  ASSERT_EQ(DriveAhead(w).n_points, 1);
  w.Order(mission_command_t::ABORT);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::FAILED);
  const auto paths = w.paths.Drain();
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].n_points, 0);
}

TEST(SecondMission, TheDoorWaitsForItAndFollows) {
  Workstation w({}, WithDriveAhead);
  const path_t path = DriveAhead(w);
  ASSERT_EQ(path.n_points, 1);
  w.Order(mission_command_t::PASS_DOOR);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::PASSING);
  ASSERT_EQ(w.last_status.n_waiting, 1);
  EXPECT_EQ(w.last_status.waiting[0].title, "door 'laboratory'");
  w.SendLink(true);
  w.SendDrive(path.path_id, drive_status_t::ARRIVED);
  w.SendPose(3.0);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::APPROACHING);
  EXPECT_EQ(w.last_status.mission, mission_command_t::PASS_DOOR);
  EXPECT_EQ(w.last_status.n_waiting, 0);
}

TEST(SecondMission, IsNotShipped) {
  Workstation w;
  w.Order(kDriveAhead, 3);
  w.Run(2);
  EXPECT_THAT(w.log, testing::Contains("order refused: unknown mission 6"));
}

}  // namespace
}  // namespace priamos::planner
