#include "planner/planner_app.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "common/archive.hpp"
#include "test/support/temporary_folder.hpp"
#include "workstation.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

TEST(PlannerApp, TeachesTheHeadACupboardThatItWasAskedToLookAt) {
  const TemporaryFolder folder;
  std::ofstream(folder / "map.toml") << "[[cupboards]]\nid = 7\nx_m = 4.0\ny_m = 1.0\nyaw_deg = 90\n";
  PlannerConfig config;
  config.map = (folder / "map.toml").string();
  Workstation w(config);
  landmark_fix_t answer{};
  answer.utime_exposure = ToUtime(w.clock.Now());
  answer.verdict = landmark_fix_t::NO_MODEL;
  for (const int id : {8, 7}) {
    answer.landmark_id = static_cast<std::int16_t>(id);
    w.fix.Publish(answer);
    w.Run(1);
  }
  const auto models = w.models.Drain();
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models[0].landmark_id, 7);
  EXPECT_NEAR(models[0].yaw_rad, kPi / 2, 1e-9);
  EXPECT_GE(models[0].n_edges, 6);
}

TEST(PlannerApp, PassesTheDoorOnTheBus) {
  Workstation w;
  w.Order(mission_command_t::PASS_DOOR);
  w.SendLink(true);
  w.SendPose(3.1);
  w.Run(2);
  ASSERT_EQ(w.phase(), mission_status_t::APPROACHING);
  EXPECT_EQ(w.models.Drain().size(), 1u);
  auto paths = w.paths.Drain();
  ASSERT_EQ(paths.size(), 1u);

  w.SendPose(3.3, paths[0].speed_m_s);
  w.Run(2);
  auto looks = w.looks.Drain();
  ASSERT_EQ(looks.size(), 1u);
  EXPECT_EQ(looks[0].side, 1);
  w.SendCorrection(looks[0].request_id);
  w.Run(2);
  looks = w.looks.Drain();
  ASSERT_EQ(looks.size(), 1u);
  EXPECT_EQ(looks[0].side, 2);
  w.SendCorrection(looks[0].request_id);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::LOOKING_LEFT);
  w.SendPose(4.4, 0.3);
  w.Run(2);
  ASSERT_EQ(w.phase(), mission_status_t::PASSING);
  paths = w.paths.Drain();
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_NEAR(paths[0].points.back().x_m, 7.5, 1e-9);

  w.SendPose(7.5);
  w.SendDrive(paths[0].path_id, drive_status_t::ARRIVED);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::PASSING) << "by its pose alone";
  w.SendOpening(6.05);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::DONE);
}

TEST(PlannerApp, StatusComesTwiceASecondAndOnEveryChange) {
  Workstation w;
  w.Run(40);
  EXPECT_EQ(w.statuses.Drain().size(), 4u);
  w.Order(mission_command_t::PASS_DOOR);
  w.Run(1);
  const auto statuses = w.statuses.Drain();
  ASSERT_EQ(statuses.size(), 1u);
  EXPECT_EQ(statuses[0].text, "waiting for the robot's pose");
}

TEST(PlannerApp, AfterAFixThatWasNotFoundItLooksAtTheOtherSide) {
  Workstation w;
  auto fix = w.other.Advertise(channels::kLandmarkFix);
  w.Order(mission_command_t::PASS_DOOR);
  w.SendLink(true);
  w.SendPose(3.2);
  w.Run(2);
  w.SendPose(3.3, 0.3);
  w.Run(2);
  const auto first = w.looks.Drain();
  ASSERT_EQ(first.size(), 1u);
  landmark_fix_t message{};
  message.request_id = first[0].request_id;
  message.verdict = landmark_fix_t::TOO_FEW_EDGES;
  fix.Publish(message);
  w.Run(10);
  const auto second = w.looks.Drain();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_NE(second[0].side, first[0].side);
  EXPECT_NE(second[0].request_id, first[0].request_id);
}

TEST(PlannerApp, WithoutTheLinkItDoesNotStart) {
  Workstation w;
  w.Order(mission_command_t::PASS_DOOR);
  w.SendLink(false);
  w.SendPose(2.6);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::WAITING);
  EXPECT_TRUE(w.paths.Drain().empty());
}

TEST(PlannerApp, AbortSendsAnEmptyPath) {
  Workstation w;
  w.Order(mission_command_t::PASS_DOOR);
  w.SendLink(true);
  w.SendPose(2.6);
  w.Run(2);
  w.paths.Drain();
  w.Order(mission_command_t::ABORT);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::FAILED);
  const auto paths = w.paths.Drain();
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].n_points, 0);
}

/// The robot may follow the path of a planner that was killed.
TEST(PlannerApp, AbortWithoutAMissionOrdersTheRobotToStandUntilItConfirmsThat) {
  Workstation w;
  w.SendLink(true);
  w.SendPose(2.6, 0.3);
  w.SendDrive(77, drive_status_t::FOLLOWING);
  w.Run(2);
  w.Order(mission_command_t::ABORT);
  w.Run(2);
  auto paths = w.paths.Drain();
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].n_points, 0);
  EXPECT_NE(paths[0].path_id, 0);
  w.phase();
  EXPECT_EQ(w.last_status.text, "no mission was under way; the robot is told to stand");
  const auto seconds = [&](int n) {
    for (int i = 0; i < n; ++i) {
      w.SendPose(2.6, 0.3);
      w.Run(20);
    }
  };
  seconds(12);
  const auto again = w.paths.Drain();
  ASSERT_GE(again.size(), 1u) << "the robot follows its path still";
  EXPECT_EQ(again[0].path_id, paths[0].path_id);
  w.SendDrive(paths[0].path_id, drive_status_t::HOLDING);
  seconds(12);
  EXPECT_TRUE(w.paths.Drain().empty());
}

TEST(PlannerApp, AnAbortWithANumberIsAnsweredUnderIt) {
  Workstation w;
  mission_command_t abort{};
  abort.utime = ToUtime(w.clock.Now());
  abort.mission = mission_command_t::ABORT;
  abort.order_id = 4711;
  for (int i = 0; i < 2; ++i) {
    w.order.Publish(abort);
    w.Run(2);
  }
  w.phase();
  ASSERT_EQ(w.last_status.n_results, 1);
  EXPECT_EQ(w.last_status.results[0].order_id, 4711);
  EXPECT_EQ(w.last_status.results[0].text, "no mission was under way; the robot is told to stand");
  EXPECT_EQ(w.paths.Drain().size(), 2u) << "said again it is done again";
}

/// Who waits for the end of an order hears of it, however many end with it.
TEST(PlannerApp, EveryEndIsInAStatus) {
  Workstation w;
  for (int i = 1; i <= 8; ++i) {
    mission_command_t order{};
    order.utime = ToUtime(w.clock.Now());
    order.mission = mission_command_t::GOTO;
    order.order_id = 100 + i;
    order.x_m = 2;
    order.y_m = 2.4;
    w.order.Publish(order);
  }
  w.Run(2);
  w.statuses.Drain();
  w.Order(mission_command_t::ABORT);
  w.Run(2);
  std::set<int> ended;
  for (const mission_status_t& status : w.statuses.Drain()) {
    EXPECT_LE(status.n_results, 3);
    for (const mission_result_t& result : status.results) ended.insert(result.order_id);
    w.last_status = status;
  }
  EXPECT_EQ(ended, (std::set<int>{101, 102, 103, 104, 105, 106, 107, 108}));
  EXPECT_EQ(w.last_status.results.back().order_id, 101) << "that which was under way ended last";
}

TEST(PlannerApp, UnknownMissionIsRefusedInTheLog) {
  Workstation w;
  w.Order(7);
  w.Run(2);
  EXPECT_EQ(w.phase(), mission_status_t::WAITING);
  EXPECT_THAT(w.log, testing::Contains(HasSubstr("unknown mission 7")));
}

TEST(PlannerApp, MissingMapIsASentence) {
  PlannerConfig config;
  config.map = "maps/nowhere.toml";
  EXPECT_THROW(Workstation w(config), ConfigError);
}

}  // namespace
}  // namespace priamos::planner
