#include "radio/radio_app.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "bus/type_files.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

using testing::HasSubstr;

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
    EXPECT_NEAR(channel.messages, 20, 5);
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

std::string StartError(const std::string& text, const std::string& link = "") {
  const TemporaryFolder folder;
  std::ofstream(folder / "radio.toml") << text;
  std::ofstream(folder / "link.toml") << link;
  const bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep(schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}});
  lockstep.AddBus("onboard");
  lockstep.AddSerialLine("a", "b", {});
  try {
    lockstep.AddApp(bus::FactoryOf<RadioApp>(), "onboard", {(folder / "radio.toml").string(), {}});
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

constexpr const char* kPoseLink = R"(
simulation_key = true
[[channel]]
name = "POSE"
type = "pose_t"
)";

// ---- Types the program was never compiled with, and channels that are sent on request.

constexpr const char* kForeignType =
    "package yours;\n"
    "struct tank_t {\n"
    "  int64_t timestamp;  // [us] @age 1000000 @step 10000: when\n"
    "  double level_m;     // [m] @range 0,10 @step 0.01: water\n"
    "}\n";
constexpr const char* kForeignLink = R"(
simulation_key = true
[[channel]]
name = "TANK"
type = "tank_t"
rate_hz = 10
[[channel]]
name = "DETAILS"
type = "tank_t"
rate_hz = 10
on_request = true
)";

/// One link.toml for both ends, given as their configuration, and a folder of types.
struct ForeignTypes : testing::Test {
  ForeignTypes() {
    std::filesystem::create_directories(folder / "types");
    std::ofstream(folder / "types" / "tank_t.lcm") << kForeignType;
    std::ofstream(folder / "link.toml") << kForeignLink;
    types = (folder / "types").string();
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(
          bus::FactoryOf<RadioApp>(), side,
          {(folder / "link.toml").string(), {"side=" + side, "port=tty-" + side, "types=" + types}});
    lockstep.SetTap([&](std::string_view bus, Time, std::string_view channel, auto bytes) {
      if (bus == "offboard" && channel == "TANK") tanks.emplace_back(bytes.begin(), bytes.end());
      if (bus == "offboard" && channel == "DETAILS") ++details;
    });
  }
  std::vector<std::byte> Tank(double level_m) {
    const bus::Schema foreign(bus::ReadTypeFiles(types));
    return bus::FromJson(*foreign.Find("tank_t"),
                         {{"timestamp", ToUtime(lockstep.now())}, {"level_m", level_m}});
  }
  void Run(double seconds) {
    const Time end = lockstep.now() + FromSeconds(seconds);
    while (lockstep.now() < end) {
      for (const char* channel : {"TANK", "DETAILS"})
        lockstep.DriverNode("onboard").PublishRaw(channel, Tank(1.234));
      lockstep.RunUntil(lockstep.now() + FromSeconds(0.05));
    }
  }

  TemporaryFolder folder;
  bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
  std::string types;
  std::vector<std::vector<std::byte>> tanks;
  int details = 0;
};

TEST_F(ForeignTypes, AreBridged) {
  Run(2);
  ASSERT_GT(tanks.size(), 10U);
  const bus::Schema foreign(bus::ReadTypeFiles(types));
  EXPECT_NEAR(bus::ToJson(*foreign.Find("tank_t"), tanks.back()).at("level_m").get<double>(), 1.23, 1e-9);
}

TEST_F(ForeignTypes, OnRequestIsSentWhileSomebodyListens) {
  Run(2);
  EXPECT_EQ(details, 0);
  auto requests = lockstep.DriverNode("offboard").Advertise(channels::kLinkRequest);
  link_request_t request{};
  request.channel = "DETAILS";
  request.hold_s = 2;
  requests.Publish(request);
  Run(1.5);
  EXPECT_GT(details, 8);
  Run(1.5);
  details = 0;
  Run(2);
  EXPECT_EQ(details, 0);
}

TEST_F(ForeignTypes, StatusCountsWhatNobodyWanted) {
  auto status = lockstep.DriverNode("onboard").Subscribe(channels::kLinkStatus);
  Run(3);
  ASSERT_NE(status.get(), nullptr);
  ASSERT_EQ(status.get()->all_channels, 2);
  EXPECT_TRUE(status.get()->onboard);
  EXPECT_GT(status.get()->channels[1].unwanted, 30);
  EXPECT_EQ(status.get()->channels[0].unwanted, 0);
  EXPECT_GT(status.get()->utilisation_in, 0);
}

TEST(RadioAppStart, KeysOfALinkWithoutChannelsAreRefused) {
  EXPECT_THAT(StartError("port = 'a'\nbaud = 1200", kPoseLink), HasSubstr("channel"));
}

TEST(RadioAppStart, UdpNeedsDatagrams) {
  EXPECT_THAT(StartError("port = 'udp:127.0.0.1:9000'", kPoseLink), HasSubstr("datagrams: expected true"));
}

TEST(RadioAppStart, ShippedConfigurationFits) {
  EXPECT_EQ(StartError("port = 'a'", kPoseLink), "");
}

TEST(RadioAppStart, RefusesALinkThatCannotHold) {
  EXPECT_THAT(StartError("port = 'a'", std::string(kPoseLink) + "rate_hz = 100"),
              HasSubstr("expected at most 960 byte/s"));
  EXPECT_THAT(StartError("port = 'a'", std::string(kPoseLink) + "deadline_s = 0.01"),
              HasSubstr("deadline_s"));
}

TEST(RadioAppStart, RefusesWhatMustNeverCrossTheRadio) {
  for (const char* channel : {"name='CLAIM'\ntype='claim_t'", "name='WHEEL_COMMAND'\ntype='wheel_command_t'"})
    EXPECT_THAT(StartError("port = 'a'", std::string("simulation_key=true\n[[channel]]\n") + channel),
                HasSubstr("expected one that may cross the radio"));
}

TEST(RadioAppStart, RefusesAMissingKey) {
  EXPECT_THAT(StartError("port = 'a'", "[[channel]]\nname='POSE'\ntype='pose_t'"),
              HasSubstr("priamos link keygen"));
}

TEST(RadioAppStart, RefusesUnknownTypes) {
  EXPECT_THAT(StartError("port = 'a'", "simulation_key=true\n[[channel]]\nname='POSE'\ntype='pos_t'"),
              HasSubstr("got \"pos_t\""));
}

}  // namespace
}  // namespace priamos::radio
