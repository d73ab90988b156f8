#include "robot/robot_app.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "bus/own_types.hpp"
#include "test/robot/support/simulated_base.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::robot {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;

/// The robot on a bus of its own, with a simulated base as its drive board.
struct Onboard {
  explicit Onboard(const RobotConfig& config = {}) : dut(config, context) {}

  void Step() {
    base.Advance(std::chrono::milliseconds(20));
    clock.Set(base.now());
    if (wheels_answer) SendWheels();
    if (++ticks % 5 == 0) SendSonars();
    bus.Drain();
    dut.Tick(clock.Now());
    bus.Drain();
    if (const auto message = command.Take()) {
      last_command = *message;
      base.Command({message->speed_rad_s[0], message->speed_rad_s[1], message->speed_rad_s[2],
                    message->speed_rad_s[3]},
                   clock.Now());
    }
    if (const auto message = status.Take()) {
      last_status = *message;
      ++statuses;
    }
  }
  void Run(double seconds) {
    for (int i = 0; i < seconds * 50; ++i) Step();
  }
  void SendWheels() {
    const WheelSample sample = base.Read();
    wheel_state_t message{};
    message.utime = ToUtime(sample.time);
    std::copy(sample.ticks.begin(), sample.ticks.end(), message.position_ticks);
    wheels.Publish(message);
  }
  void SendSonars() {
    sonar_ranges_t message{};
    message.utime = ToUtime(clock.Now());
    std::fill(std::begin(message.range_m), std::end(message.range_m), -1);
    for (const int i : {5, 6, 7, 17, 18, 19}) message.range_m[i] = beside_m;
    sonars.Publish(message);
  }
  void SendPath(int id, double x_m, double speed_m_s = 0.4) {
    path_t message{};
    message.utime = ToUtime(clock.Now());
    message.path_id = id;
    message.estop_changes = last_status.estop_changes;
    message.speed_m_s = speed_m_s;
    message.points.resize(1);
    message.points[0].x_m = x_m;
    message.n_points = 1;
    paths.Publish(message);
  }
  void SendLease(int action, int session = 7, int driver = lease_request_t::TELEOP, double age_s = 0) {
    lease_request_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.driver = static_cast<std::int8_t>(driver);
    message.session = static_cast<std::int16_t>(session);
    message.action = static_cast<std::int8_t>(action);
    leases.Publish(message);
  }
  void SendCommand(double vx_m_s, int session = 7, double age_s = 0) {
    drive_command_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.driver = lease_request_t::TELEOP;
    message.session = static_cast<std::int16_t>(session);
    message.sequence = ++sequence;
    message.time_to_live_s = 0.2;
    message.vx_m_s = vx_m_s;
    commands.Publish(message);
  }
  void SendEstop(int action, double age_s = 0) {
    estop_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.action = static_cast<std::int8_t>(action);
    estops.Publish(message);
  }
  /// 25 commands per second.
  void Drive(double vx_m_s, double seconds) {
    for (int i = 0; i < seconds * 50; ++i) {
      if (i % 2 == 0) SendCommand(vx_m_s);
      Step();
    }
  }
  /// The verdict on an order to set the pose to (4, 1), heading 1.
  int VerdictOnPose(double x_m = 4, double age_s = 0) {
    pose_reset_t message{};
    message.utime = ToUtime(clock.Now() - FromSeconds(age_s));
    message.request_id = ++poses;
    message.x_m = x_m;
    message.y_m = 1;
    message.yaw_rad = 1;
    message.sigma_m = 0.1;
    message.sigma_yaw_rad = 0.05;
    corrections.Drain();
    for (int i = 0; i < 2; ++i) pose_resets.Publish(message);  // said again, before the answer was there
    Step();
    const auto answers = corrections.Drain();
    const bool same = answers.size() == 2 && answers[0].utime == answers[1].utime;
    return same && answers[0].request_id == poses ? answers[0].verdict : -1;
  }
  landmark_fix_t Fix(int id) {
    const Pose2 seen = base.truth().Inverse() * Pose2{6, 0, 0};
    landmark_fix_t message{};
    message.utime_exposure = ToUtime(clock.Now());
    message.request_id = id;
    message.x_m = seen.x;
    message.y_m = seen.y;
    message.yaw_rad = seen.yaw;
    message.sigma_x_m = message.sigma_y_m = 0.01;
    message.sigma_yaw_rad = 0.005;
    message.model_x_m = 6;
    return message;
  }

  bool wheels_answer = true;
  double beside_m = -1;  ///< range of the sonars abeam
  int ticks = 0, statuses = 0, sequence = 0, poses = 8;
  SimulatedBase base{1, {0.05, 0.1, 0.02}};
  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{base.now()};
  bus::LcmBus bus{"memq://"};
  bus::Node node{bus, schema, clock}, other{bus, schema, clock};
  std::vector<std::string> log;
  bus::Context context{node, [this] {
                         bus::Surroundings around;
                         around.claimant = 77;
                         around.log = [this](bus::Level, std::string_view text) { log.emplace_back(text); };
                         return around;
                       }()};
  RobotApp dut;
  bus::Publisher<wheel_state_t> wheels = other.Advertise(channels::kWheelState);
  bus::Publisher<motor_current_t> currents = other.Advertise(channels::kMotorCurrent);
  bus::Publisher<bumper_t> bumper = other.Advertise(channels::kBumper);
  bus::Publisher<sonar_ranges_t> sonars = other.Advertise(channels::kSonarRanges);
  bus::Publisher<path_t> paths = other.Advertise(channels::kPath);
  bus::Publisher<landmark_fix_t> fixes = other.Advertise(channels::kLandmarkFix);
  bus::Publisher<pose_reset_t> pose_resets = other.Advertise(channels::kPoseReset);
  bus::Publisher<lease_request_t> leases = other.Advertise(channels::kLeaseRequest);
  bus::Publisher<drive_command_t> commands = other.Advertise(channels::kDriveCommand);
  bus::Publisher<estop_t> estops = other.Advertise(channels::kEstop);
  bus::Publisher<link_status_t> links = other.Advertise(channels::kLinkStatus);
  bus::Latest<wheel_command_t> command = other.Subscribe(channels::kWheelCommand);
  bus::Inbox<opening_t> openings = other.SubscribeAll(channels::kOpening);
  bus::Latest<odometry_t> odometry = other.Subscribe(channels::kOdometry);
  bus::Latest<pose_t> pose = other.Subscribe(channels::kPose);
  bus::Latest<drive_status_t> status = other.Subscribe(channels::kDriveStatus);
  bus::Inbox<features_t> features = other.SubscribeAll(channels::kFeatures);
  bus::Publisher<features_ack_t> feature_acks = other.Advertise(channels::kFeaturesAck);
  bus::Inbox<pose_correction_t> corrections = other.SubscribeAll(channels::kPoseCorrection);
  std::optional<wheel_command_t> last_command;
  drive_status_t last_status{};
};

TEST(RobotApp, SaysWhereItIsBeforeItIsToldToMove) {
  Onboard robot;
  robot.Run(0.5);
  ASSERT_TRUE(robot.pose.get());
  ASSERT_TRUE(robot.odometry.get());
  EXPECT_FALSE(robot.last_command);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::IDLE);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_NONE);
}

TEST(RobotApp, ReportsItsStatusTenTimesPerSecond) {
  Onboard robot;
  robot.Run(5);
  EXPECT_NEAR(robot.statuses, 50, 1);
}

TEST(RobotApp, DrivesAPathAndReportsIt) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(3);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::FOLLOWING);
  EXPECT_EQ(robot.last_status.path_id, 4);
  EXPECT_NEAR(robot.last_status.speed_m_s, 0.4, 0.05);
  robot.Run(10);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::ARRIVED);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

TEST(RobotApp, APersonSetsItsPoseWhileItStands) {
  Onboard robot;
  robot.Run(0.5);
  EXPECT_EQ(robot.VerdictOnPose(), pose_correction_t::RESET);
  robot.Run(0.1);
  EXPECT_NEAR(robot.pose.get()->x_m, 4, 0.01);
  EXPECT_NEAR(robot.pose.get()->yaw_rad, 1, 0.01);
  EXPECT_NEAR(robot.pose.get()->sigma_x_m, 0.1, 0.01);
  EXPECT_THAT(robot.log, Contains(HasSubstr("pose 9 set by order: (4.00, 1.00), 57 deg")));
}

TEST(RobotApp, AfterAPathItsNewPoseDoesNotLeadItBack) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 1);
  robot.Run(8);
  ASSERT_EQ(robot.last_status.mode, drive_status_t::ARRIVED);
  EXPECT_EQ(robot.VerdictOnPose(), pose_correction_t::RESET);
  robot.Run(2);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  EXPECT_NEAR(robot.pose.get()->x_m, 4, 0.02);
}

TEST(RobotApp, APoseIsNotSetWhileItDrivesNorTooLateNorOutsideTheMap) {
  Onboard robot;
  robot.Run(0.5);
  EXPECT_EQ(robot.VerdictOnPose(4, 11), pose_correction_t::TOO_OLD);
  EXPECT_EQ(robot.VerdictOnPose(101), pose_correction_t::IMPLAUSIBLE);
  EXPECT_EQ(robot.VerdictOnPose(std::nan("")), pose_correction_t::IMPLAUSIBLE);
  robot.SendPath(4, 3);
  robot.Run(1);
  EXPECT_EQ(robot.VerdictOnPose(), pose_correction_t::MOVING);
  EXPECT_LT(robot.pose.get()->x_m, 1);
}

TEST(RobotApp, YieldingItCommandsItsWheelsToStandAndNobodyElses) {
  Onboard robot;
  robot.Run(0.2);
  robot.dut.Yield(robot.clock.Now());
  robot.bus.Drain();
  EXPECT_FALSE(robot.command.Take()) << "it has never commanded them";
  robot.SendPath(4, 3);
  robot.Run(1);
  EXPECT_NE(robot.last_command->speed_rad_s[0], 0);
  EXPECT_EQ(robot.last_command->instance, 77);
  robot.dut.Yield(robot.clock.Now());
  robot.bus.Drain();
  const auto last = robot.command.Take();
  ASSERT_TRUE(last);
  EXPECT_THAT(last->speed_rad_s, Each(0.0));
  EXPECT_EQ(last->instance, 77);
}

TEST(RobotApp, SaysThatTheBoardHoldsTheWheelsBecauseOfAnother) {
  Onboard robot;
  robot.Run(0.2);
  wheel_state_t message{};
  message.utime = ToUtime(robot.clock.Now());
  message.contested = 1;
  message.foreign_commands = 3;
  robot.wheels.Publish(message);
  robot.Step();
  EXPECT_THAT(robot.log, Contains(HasSubstr("another process commands them, too; 3 of its commands")));
  robot.Run(0.1);
  EXPECT_THAT(robot.log, Contains(HasSubstr("by one process again")));
}

TEST(RobotApp, ATouchHaltsItWidensItsPoseAndIsReported) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(2);
  const double sigma_m = robot.pose.get()->sigma_x_m;
  bumper_t message{};
  message.utime = ToUtime(robot.clock.Now());
  message.pressed = bumper_t::FRONT_LEFT;
  robot.bumper.Publish(message);
  robot.Run(0.3);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_TOUCHED);
  EXPECT_THAT(robot.log, Contains(HasSubstr("touched something at the front's left half")));
  // It may have slipped by 0.02 m + 0.25 s * 0.4 m/s.
  EXPECT_GT(robot.pose.get()->sigma_x_m, std::hypot(sigma_m, 0.1));
}

TEST(RobotApp, CurrentsThatAreNoNumbersAreNoTouch) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  for (int i = 0; i < 50; ++i) {
    motor_current_t message{};
    message.utime = ToUtime(robot.clock.Now());
    for (double& current : message.current_a) current = std::nan("");
    robot.currents.Publish(message);
    robot.Step();
  }
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_NONE);
}

TEST(RobotApp, RepeatsTheOpeningItDroveThrough) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(1);
  robot.beside_m = 0.12;
  robot.Run(2);
  robot.beside_m = -1;
  EXPECT_TRUE(robot.openings.Drain().empty());
  robot.Run(4);
  const auto openings = robot.openings.Drain();
  EXPECT_NEAR(double(openings.size()), 4, 1);
  ASSERT_FALSE(openings.empty());
  EXPECT_NEAR(openings[0].width_m, 0.78 + 0.24, 1e-6);
  EXPECT_EQ(openings[0].utime, openings.back().utime) << "of the same opening";
}

TEST(RobotApp, AnswersAFixAndMovesItsPose) {
  Onboard robot;
  robot.Run(0.5);
  robot.fixes.Publish(robot.Fix(11));
  robot.Run(0.1);
  const auto answers = robot.corrections.Drain();
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].verdict, pose_correction_t::APPLIED);
  EXPECT_EQ(answers[0].request_id, 11);
  EXPECT_NEAR(answers[0].dy_m, 0.1, 0.01);
  EXPECT_NEAR(robot.pose.get()->y_m, 0.1, 0.01);
}

TEST(RobotApp, AnswersAFixThatTheHeadCouldNotGive) {
  Onboard robot;
  robot.Run(0.5);
  landmark_fix_t fix = robot.Fix(12);
  fix.verdict = landmark_fix_t::NOT_VISIBLE;
  robot.fixes.Publish(fix);
  robot.Run(0.1);
  EXPECT_EQ(robot.corrections.Drain().at(0).verdict, pose_correction_t::NOT_FOUND);
}

TEST(RobotApp, AnswersARepeatedFixOnce) {
  Onboard robot;
  robot.Run(0.5);
  const landmark_fix_t fix = robot.Fix(13);
  robot.fixes.Publish(fix);
  robot.fixes.Publish(fix);
  robot.Run(0.1);
  EXPECT_EQ(robot.corrections.Drain().size(), 1u);
}

TEST(RobotApp, StopsAndSaysWhyWhenTheWheelsFallSilent) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(3);
  robot.wheels_answer = false;
  robot.Run(1);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_WHEELS_SILENT);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  EXPECT_EQ(robot.context.health(), bus::Health::kDegraded);
  EXPECT_THAT(robot.log, Contains(HasSubstr("no credible encoder sample")));
  robot.wheels_answer = true;
  robot.Run(1);
  EXPECT_EQ(robot.context.health(), bus::Health::kOk);
}

TEST(RobotApp, RefusesAPathThatCannotBeDriven) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, std::nan(""));
  robot.Run(0.2);
  EXPECT_FALSE(robot.last_command);
  EXPECT_THAT(robot.log, Contains(HasSubstr("path 4 refused")));
}

TEST(RobotApp, AnOperatorTakesTheLeaseAndDrives) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 2);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::OPERATED);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::TELEOP);
  EXPECT_EQ(robot.last_status.session, 7);
  EXPECT_EQ(robot.last_status.allowed, 1);
  EXPECT_NEAR(robot.last_status.speed_m_s, 0.4, 0.05);
  EXPECT_EQ(robot.last_status.refused, 0);
}

TEST(RobotApp, CommandsWithoutLeaseAreRefusedCountedAndNamed) {
  Onboard robot;
  robot.Run(0.2);
  robot.Drive(0.4, 1);
  EXPECT_FALSE(robot.last_command);
  EXPECT_NEAR(robot.last_status.refused, 25, 3);  // as of the newest status
  EXPECT_EQ(robot.last_status.refusal, drive_status_t::REFUSED_WITHOUT_LEASE);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::NOBODY);
}

TEST(RobotApp, ACommandThatWasTooLongOnTheRadioIsRefused) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.SendCommand(0.4, 7, 0.25);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.refusal, drive_status_t::REFUSED_TOO_OLD);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

TEST(RobotApp, ALeaseRequestThatComesMuchTooLateIsNotGranted) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::TAKE_OVER, 7, lease_request_t::TELEOP, 3);
  robot.SendLease(99);
  robot.SendLease(lease_request_t::ACQUIRE, 7, 55);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::NOBODY);
}

TEST(RobotApp, ThePlannersPathIsDrivenWithTheLeaseAndEndsWhenItIsTaken) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::PLANNER);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::PLANNER) << "only a take-over takes it";
  robot.SendLease(lease_request_t::TAKE_OVER);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::TELEOP);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_LEASE_LOST);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

/// A robot, and the one that is started after it.
class RestartTest : public testing::Test {
 protected:
  RestartTest() { config_.state_file = (folder_ / "robot-state").string(); }
  /// Ends the robot so that the file is left as by kill -9 or a loss of power.
  void Crash(std::unique_ptr<Onboard> robot) {
    std::filesystem::copy_file(config_.state_file, folder_ / "kept");
    robot.reset();
    std::filesystem::rename(folder_ / "kept", config_.state_file);
  }
  std::unique_ptr<Onboard> Started() {
    auto robot = std::make_unique<Onboard>(config_);
    robot->Run(0.3);
    return robot;
  }
  /// Whether an operator can drive it.
  static bool Drives(Onboard& robot) {
    robot.SendLease(lease_request_t::ACQUIRE);
    robot.Drive(0, 0.1);
    robot.Drive(0.3, 0.5);
    return robot.last_command && robot.last_command->speed_rad_s[0] > 1;
  }

  TemporaryFolder folder_;
  RobotConfig config_;
};

TEST_F(RestartTest, AfterAnOrderlyEndItDrives) {
  EXPECT_TRUE(Drives(*Started()));
  EXPECT_TRUE(Drives(*Started()));
}

TEST_F(RestartTest, ALatchedEstopOutlivesAnOrderlyEnd) {
  auto robot = Started();
  robot->SendEstop(estop_t::STOP);
  robot->Run(0.1);
  robot.reset();
  robot = Started();
  EXPECT_TRUE(robot->last_status.estop);
  EXPECT_FALSE(Drives(*robot));
}

TEST_F(RestartTest, ALatchedEstopOutlivesACrash) {
  auto robot = Started();
  robot->SendEstop(estop_t::STOP);
  robot->Run(0.02);
  Crash(std::move(robot));
  EXPECT_TRUE(Started()->last_status.estop);
}

TEST_F(RestartTest, AfterACrashNeitherOperatorNorPathMovesItBeforeSomebodyReArms) {
  auto robot = Started();
  ASSERT_TRUE(Drives(*robot));
  Crash(std::move(robot));
  robot = Started();
  EXPECT_TRUE(robot->last_status.estop);
  EXPECT_THAT(robot->log, Contains(HasSubstr("did not end in order")));
  EXPECT_FALSE(Drives(*robot));
  robot->SendPath(1, 2);
  robot->Run(0.5);
  EXPECT_FALSE(robot->last_command) << "the planner repeats its path by itself";
  robot->SendEstop(estop_t::REARM);
  robot->Run(0.1);
  EXPECT_TRUE(Drives(*robot));
}

TEST_F(RestartTest, ARearmingThatCannotBeWrittenDownIsNone) {
  auto robot = Started();
  robot->SendEstop(estop_t::STOP);
  robot->Run(0.1);
  std::filesystem::create_directory(config_.state_file + ".new");
  robot->SendEstop(estop_t::REARM);
  robot->Run(0.1);
  EXPECT_TRUE(robot->last_status.estop);
  std::filesystem::remove(config_.state_file + ".new");
  robot->SendEstop(estop_t::REARM);
  robot->Run(0.1);
  EXPECT_FALSE(robot->last_status.estop);
}

TEST(RobotApp, EstopFromAnybodyStopsAtTheNextTickAndOnlyAFreshRearmLiftsIt) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 1);
  robot.SendEstop(estop_t::STOP, 60);  // however old
  robot.Step();
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  robot.Drive(0.4, 0.5);
  EXPECT_TRUE(robot.last_status.estop);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_ESTOP);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  robot.SendEstop(estop_t::REARM, 3);
  robot.Run(0.2);
  EXPECT_TRUE(robot.last_status.estop) << "an old re-arming";
  robot.SendEstop(estop_t::REARM);
  robot.Drive(0.4, 0.5);
  EXPECT_FALSE(robot.last_status.estop);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0)) << "the stick was not let go";
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 0.5);
  EXPECT_GT(robot.last_command->speed_rad_s[0], 1);
}

TEST(RobotApp, ARadioThatSaysItIsDownStopsTheOperator) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 1);
  robot.links.Publish(link_status_t{});
  robot.Drive(0.4, 0.4);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_LINK_LOST);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

TEST(RobotApp, WallsAreToldUntilTheyAreAcknowledged) {
  Onboard robot;
  robot.Run(0.2);
  robot.beside_m = 1.0;
  robot.SendPath(1, 2.5);
  robot.Run(8);
  const auto told = robot.features.Drain();
  ASSERT_GE(told.size(), 1u);
  ASSERT_GE(told.back().n_features, 1);
  const feature_t& wall = told.back().features[0];
  EXPECT_EQ(wall.kind, feature_t::WALL);
  EXPECT_GT(wall.length_m, 0.6);
  EXPECT_NEAR(std::abs(wall.y_m), 1.39, 0.4) << "the start is known to 20 cm";
  EXPECT_GT(wall.sigma_across_m, 0.05) << "and so is the wall";
  robot.Run(40);
  const auto again = robot.features.Drain();
  ASSERT_GE(again.size(), 2u) << "nobody has acknowledged it";
  features_ack_t ack{};
  ack.store = again.back().store;
  for (const features_t& batch : again) {
    ack.batch = batch.batch;
    robot.feature_acks.Publish(ack);
  }
  robot.Run(15);
  for (const features_t& batch : robot.features.Drain()) {
    ack.batch = batch.batch;
    robot.feature_acks.Publish(ack);
  }
  robot.Run(15);
  EXPECT_THAT(robot.features.Drain(), testing::IsEmpty());
}

TEST(RobotApp, APathThatIsOldIsRefused) {
  Onboard robot;
  robot.Run(0.2);
  path_t path{};
  path.utime = ToUtime(robot.clock.Now() - FromSeconds(11));
  path.path_id = 4;
  path.speed_m_s = 0.4;
  path.points.resize(1);
  path.n_points = 1;
  robot.paths.Publish(path);
  robot.Run(0.2);
  EXPECT_FALSE(robot.last_command);
  EXPECT_THAT(robot.log, Contains(HasSubstr("path 4 refused: too old")));
}

}  // namespace
}  // namespace priamos::robot
