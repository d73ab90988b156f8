#include "radio/radio_app.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <set>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"

namespace priamos::radio {
namespace {

const std::string kConfig = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/radio.toml";

/// Both ends of a link, each on its bus, in lockstep.
struct RadioAppTest : testing::Test {
  explicit RadioAppTest(const bus::radio::LineConfig& line = {}) {
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", line);
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(bus::FactoryOf<RadioApp>(), side, {kConfig, {"side=" + side, "port=tty-" + side}});
  }
  void Run(double seconds) { lockstep.RunUntil(lockstep.now() + FromSeconds(seconds)); }
  bus::Node& onboard() { return lockstep.DriverNode("onboard"); }
  bus::Node& offboard() { return lockstep.DriverNode("offboard"); }

  bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
};

TEST_F(RadioAppTest, PoseReachesTheOtherBusWithItsAge) {
  auto poses = offboard().Subscribe(channels::kPose);
  auto publisher = onboard().Advertise(channels::kPose);
  Run(1);
  pose_t pose{};
  pose.utime = ToUtime(lockstep.now()) - 200'000;
  pose.x_m = 1.234;
  pose.yaw_rad = -0.5;
  publisher.Publish(pose);
  Run(0.5);
  const pose_t* received = poses.get();
  ASSERT_NE(received, nullptr);
  EXPECT_NEAR(received->x_m, 1.234, 0.0051);
  EXPECT_NEAR(received->yaw_rad, -0.5, 0.00051);
  EXPECT_NEAR(static_cast<double>(received->utime - pose.utime), 0, 20'000);
}

/// However late it comes onto the bus: the radio counts a command's age from its own stamp.
TEST_F(RadioAppTest, ACommandThatIsTooOldOnTheBusIsNotSent) {
  auto commands = onboard().SubscribeAll(channels::kDriveCommand);
  auto status = offboard().Subscribe(channels::kLinkStatus);
  auto publisher = offboard().Advertise(channels::kDriveCommand);
  Run(3);
  drive_command_t command{};
  command.time_to_live_s = 0.25;
  int expired = 0;
  for (const int age_us : {0, 100'000, 300'000, 60'000'000, -1'000'000}) {
    const std::int64_t offered = ToUtime(lockstep.now());
    command.utime = offered - age_us;
    ++command.sequence;
    publisher.Publish(command);
    Run(1.1);
    const auto came = commands.Drain();
    ASSERT_EQ(came.size(), age_us < 200'000 ? 1u : 0u) << age_us;
    for (const drive_command_t& arrived : came) {
      EXPECT_LE(arrived.utime, std::min(command.utime, ToUtime(lockstep.now())) + 1000)
          << "never younger than it is";
      EXPECT_GE(arrived.utime, std::min(command.utime, offered) - 70'000)
          << "nor older by the step of its stamp, 0.1 s: of what counts from it nothing is rounded";
    }
    expired += age_us > 200'000 ? 1 : 0;
    EXPECT_EQ(status.get()->dropped, expired) << age_us;
  }
  command.utime = std::numeric_limits<std::int64_t>::min();
  publisher.Publish(command);
  Run(1.5);
  EXPECT_TRUE(commands.Drain().empty());
}

/// Not to send a stop is the unsafe side; to send a REARM that nobody can have meant is the other.
TEST_F(RadioAppTest, AStopCrossesWhateverItsOtherFieldsHoldAndAReArmDoesNot) {
  auto stops = onboard().SubscribeAll(channels::kEstop);
  auto publisher = offboard().Advertise(channels::kEstop);
  auto status = offboard().Subscribe(channels::kLinkStatus);
  Run(0.5);
  for (const int driver : {4, -1, 127, -128, 2}) {
    for (const std::int8_t action : {estop_t::STOP, estop_t::REARM}) {
      estop_t message{};
      message.utime = driver == 127 ? std::numeric_limits<std::int64_t>::min() : ToUtime(lockstep.now());
      message.action = action;
      message.driver = static_cast<std::int8_t>(driver);
      publisher.Publish(message);
      Run(0.5);
      const auto came = stops.Drain();
      ASSERT_EQ(came.size(), action == estop_t::STOP || driver == 2 ? 1U : 0U) << driver;
      for (const estop_t& arrived : came) EXPECT_EQ(arrived.driver, std::clamp(driver, 0, 3));
    }
  }
  Run(1.5);
  ASSERT_NE(status.get(), nullptr);
  EXPECT_EQ(status.get()->dropped, 4) << "the REARMs with no driver";
}

/// Half a step beside the range is the nearest value; a number that is none has none.
TEST_F(RadioAppTest, NoNumberAndNoIdentityArriveAsAnotherOne) {
  auto commands = onboard().SubscribeAll(channels::kDriveCommand);
  auto publisher = offboard().Advertise(channels::kDriveCommand);
  Run(1);
  const auto arrives = [&](double vx_m_s, int session, int sequence) {
    drive_command_t command{};
    command.utime = ToUtime(lockstep.now());
    command.time_to_live_s = 0.25;
    command.vx_m_s = vx_m_s;
    command.session = static_cast<std::int16_t>(session);
    command.sequence = sequence;
    publisher.Publish(command);
    Run(0.5);
    return !commands.Drain().empty();
  };
  EXPECT_TRUE(arrives(9, 255, 65535));
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(arrives(value, 1, 1)) << value;
  EXPECT_FALSE(arrives(0, 256, 1)) << "it would be session 255";
  EXPECT_FALSE(arrives(0, -1, 1));
  EXPECT_FALSE(arrives(0, 1, 65536));
  EXPECT_TRUE(arrives(0, 1, 1));
}

TEST_F(RadioAppTest, EventsCrossBothWaysOnceAndInOrder) {
  auto looks = onboard().SubscribeAll(channels::kLookRequest);
  auto fixes = offboard().SubscribeAll(channels::kLandmarkFix);
  auto look = offboard().Advertise(channels::kLookRequest);
  auto fix = onboard().Advertise(channels::kLandmarkFix);
  Run(0.5);
  for (int i = 1; i <= 3; ++i) {
    look_request_t request{};
    request.utime = ToUtime(lockstep.now());
    request.request_id = i;
    look.Publish(request);
    landmark_fix_t answer{};
    answer.utime_exposure = ToUtime(lockstep.now());
    answer.request_id = i;
    fix.Publish(answer);
    Run(1);
  }
  Run(5);
  const auto looked = looks.Drain();
  const auto fixed = fixes.Drain();
  ASSERT_EQ(looked.size(), 3U);
  ASSERT_EQ(fixed.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(looked[static_cast<std::size_t>(i)].request_id, i + 1);
    EXPECT_EQ(fixed[static_cast<std::size_t>(i)].request_id, i + 1);
  }
}

TEST_F(RadioAppTest, WhatWasPublishedBeforeTheFirstTickIsSent) {
  auto models = onboard().SubscribeAll(channels::kLandmarkModel);
  auto model = offboard().Advertise(channels::kLandmarkModel);
  landmark_model_t message{};
  message.landmark_id = 1;
  message.n_edges = 20;
  message.edges.resize(20);
  for (auto& edge : message.edges) edge.x1_m = 0.5;
  model.Publish(message);
  Run(3);
  const auto received = models.Drain();
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].edges.size(), 20U);
}

TEST_F(RadioAppTest, StatusSaysWhatWasSent) {
  auto status = onboard().Subscribe(channels::kLinkStatus);
  auto publisher = onboard().Advertise(channels::kPose);
  for (int i = 0; i < 250; ++i) {
    pose_t pose{};
    pose.utime = ToUtime(lockstep.now());
    publisher.Publish(pose);
    Run(0.02);
  }
  ASSERT_NE(status.get(), nullptr);
  EXPECT_TRUE(status.get()->up);
  EXPECT_FALSE(status.get()->alarm);
  EXPECT_EQ(status.get()->frames_rejected, 0);
  EXPECT_GT(status.get()->utilisation, 0.05);
  EXPECT_LT(status.get()->utilisation, 0.5);
  for (const auto& channel : status.get()->channels) {
    if (channel.channel != "POSE") continue;
    EXPECT_TRUE(channel.outgoing);
    EXPECT_NEAR(channel.messages, 40, 8);
  }
}

TEST_F(RadioAppTest, HealthOfEveryProcessGetsThrough) {
  auto health = offboard().SubscribeAll(channels::kHealth);
  auto publisher = onboard().Advertise(channels::kHealth);
  std::set<std::string> heard;
  for (int i = 0; i < 12; ++i) {
    for (const char* process : {"robot", "head", "world"}) {
      health_t message{};
      message.utime = ToUtime(lockstep.now());
      message.process = process;
      publisher.Publish(message);
    }
    Run(1);
  }
  for (const auto& message : health.Drain()) heard.insert(message.process);
  EXPECT_THAT(heard, testing::IsSupersetOf({"robot", "head", "world"}));
}

}  // namespace
}  // namespace priamos::radio
