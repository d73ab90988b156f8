#include "planner/planner_app.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "bus/own_types.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

/// The planner on a bus of its own, and the other end of its radio played by hand.
struct Workstation {
  explicit Workstation(const PlannerConfig& config = {}) : dut(config, context) {}

  void Step() {
    clock.Set(clock.Now() + dut.TickPeriod());
    bus.Drain();
    dut.Tick(clock.Now());
    bus.Drain();
  }
  void Run(int ticks) {
    for (int i = 0; i < ticks; ++i) Step();
  }
  void SendLink(bool up) {
    link_status_t message{};
    message.utime = ToUtime(clock.Now());
    message.up = up;
    link.Publish(message);
  }
  void SendPose(double x_m, double vx_m_s = 0) {
    pose_t message{};
    message.utime = ToUtime(clock.Now());
    message.x_m = x_m;
    message.y_m = 2.4;
    message.vx_m_s = vx_m_s;
    message.sigma_x_m = message.sigma_y_m = 0.005;
    message.sigma_yaw_rad = 0.002;
    pose.Publish(message);
  }
  void SendCorrection(int request_id) {
    pose_correction_t message{};
    message.utime = ToUtime(clock.Now());
    message.request_id = request_id;
    message.verdict = pose_correction_t::APPLIED;
    correction.Publish(message);
  }
  void SendDrive(int path_id, std::int8_t mode) {
    drive_status_t message{};
    message.utime = ToUtime(clock.Now());
    message.path_id = path_id;
    message.mode = mode;
    drive.Publish(message);
  }
  void Order(std::int8_t mission, int landmark_id = 1) {
    mission_command_t message{};
    message.utime = ToUtime(clock.Now());
    message.mission = mission;
    message.landmark_id = static_cast<std::int16_t>(landmark_id);
    order.Publish(message);
  }
  int phase() {
    for (const auto& message : statuses.Drain()) last_status = message;
    return last_status.phase;
  }

  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{FromUtime(1'000'000'000)};
  bus::LcmBus bus{"memq://"};
  bus::Node node{bus, schema, clock}, other{bus, schema, clock};
  std::vector<std::string> log;
  bus::Context context{node, [this] {
                         bus::Surroundings around;
                         around.config_dir = PRIAMOS_SOURCE_DIR "/config/sim";
                         around.log = [this](bus::Level, std::string_view text) { log.emplace_back(text); };
                         return around;
                       }()};
  PlannerApp dut;
  bus::Publisher<link_status_t> link = other.Advertise(channels::kLinkStatus);
  bus::Publisher<pose_t> pose = other.Advertise(channels::kPose);
  bus::Publisher<pose_correction_t> correction = other.Advertise(channels::kPoseCorrection);
  bus::Publisher<landmark_fix_t> fix = other.Advertise(channels::kLandmarkFix);
  bus::Publisher<drive_status_t> drive = other.Advertise(channels::kDriveStatus);
  bus::Publisher<mission_command_t> order = other.Advertise(channels::kMissionCommand);
  bus::Inbox<landmark_model_t> models = other.SubscribeAll(channels::kLandmarkModel);
  bus::Inbox<look_request_t> looks = other.SubscribeAll(channels::kLookRequest);
  bus::Inbox<path_t> paths = other.SubscribeAll(channels::kPath);
  bus::Inbox<mission_status_t> statuses = other.SubscribeAll(channels::kMissionStatus);
  mission_status_t last_status{};
};

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
