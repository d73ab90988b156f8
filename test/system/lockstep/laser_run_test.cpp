#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bus/lockstep.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "cli/lockstep/factories.hpp"
#include "lcmtypes/channels.hpp"

// The head of the shipped deployment watches the laser's line in the simulated world.

namespace priamos {
namespace {

class LaserRunTest : public testing::Test {
 protected:
  /// What the head told of the floor in the first seconds.
  std::vector<obstacle_line_t> Watch(const std::string& world, double seconds) {
    std::vector<obstacle_line_t> lines;
    bus::Lockstep lockstep(schema_, {.seed = 3});
    lockstep.AddBus("onboard");
    lockstep.SetTap([&](std::string_view, Time, std::string_view channel, std::span<const std::byte> bytes) {
      if (channel == channels::kObstacleLine.name) lines.push_back(bus::Decode<obstacle_line_t>(bytes));
    });
    const std::string sim = PRIAMOS_SOURCE_DIR "/config/sim/";
    lockstep.AddApp(cli::FactoryFor("world"), "onboard", {sim + "world.toml", {"world=worlds/" + world}});
    lockstep.AddApp(cli::FactoryFor("head"), "onboard", {sim + "head.toml", {"laser.rate_hz=2"}});
    lockstep.RunUntil(lockstep.now() + FromSeconds(seconds));
    return lines;
  }

  const bus::Schema schema_ = bus::OwnTypes();
};

/// A look goes before the watch, and the watch goes on afterwards.
TEST_F(LaserRunTest, ALookHasTheHeadAtOnceAndTheWatchGoesOn) {
  std::vector<std::string> order;
  landmark_view_t view{};
  bus::Lockstep lockstep(schema_, {.seed = 3});
  lockstep.AddBus("onboard");
  lockstep.SetTap([&](std::string_view, Time, std::string_view channel, std::span<const std::byte> bytes) {
    if (channel == channels::kLandmarkView.name) view = bus::Decode<landmark_view_t>(bytes);
    if (channel != channels::kObstacleLine.name && channel != channels::kLandmarkFix.name) return;
    if (order.empty() || order.back() != channel) order.emplace_back(channel);
  });
  const std::string sim = PRIAMOS_SOURCE_DIR "/config/sim/";
  lockstep.AddApp(cli::FactoryFor("world"), "onboard", {sim + "world.toml", {"world=worlds/sill.toml"}});
  lockstep.AddApp(cli::FactoryFor("head"), "onboard", {sim + "head.toml", {"laser.rate_hz=2"}});
  auto looks = lockstep.DriverNode("onboard").Advertise(channels::kLookRequest);
  const Time begin = lockstep.now();
  lockstep.RunUntil(begin + FromSeconds(3.2));
  look_request_t look{};
  look.request_id = 41;
  look.landmark_id = 1;
  looks.Publish(look);
  lockstep.RunUntil(begin + FromSeconds(8.5));
  EXPECT_EQ(order, (std::vector<std::string>{"OBSTACLE_LINE", "LANDMARK_FIX", "OBSTACLE_LINE"}));
  EXPECT_EQ(view.request_id, 41);
  EXPECT_EQ(view.verdict, landmark_fix_t::NO_MODEL);
  EXPECT_EQ(view.n_edges, 0);
}

TEST_F(LaserRunTest, ADuctOfThreeCentimetresIsToldWhereItLies) {
  const auto lines = Watch("sill.toml", 4.5);
  ASSERT_GE(lines.size(), 2u);
  for (const obstacle_line_t& line : lines) {
    ASSERT_EQ(line.verdict, obstacle_line_t::OBSTACLE);
    EXPECT_GT(line.seen_share, 0.9);
    ASSERT_EQ(line.n_segments, 1);
    const obstacle_segment_t& duct = line.segments[0];
    EXPECT_EQ(duct.kind, obstacle_segment_t::UP);
    EXPECT_NEAR(duct.height_m, 0.03, 3 * duct.sigma_height_m);
    EXPECT_NEAR(duct.y1_m, -0.40, 0.02);
    EXPECT_NEAR(duct.y2_m, 0.0, 0.02);
    EXPECT_NEAR((duct.x1_m + duct.x2_m) / 2, 2.02, 0.03);
  }
}

TEST_F(LaserRunTest, AFloorWithoutAnythingIsClear) {
  const auto lines = Watch("door.toml", 4.5);
  ASSERT_GE(lines.size(), 2u);
  for (const obstacle_line_t& line : lines) EXPECT_EQ(line.verdict, obstacle_line_t::CLEAR);
}

/// Straight over the duct of sill.toml, which begins at 3.95 m: where the front of the base gets to, and
/// whether it touches.
struct Drive {
  double front_m = 0;
  int contacts = 0;
};
Drive DriveAtTheDuct(const bus::Schema& schema, std::uint64_t seed, double laser_hz) {
  Drive drive;
  bus::Lockstep lockstep(schema, {.seed = seed});
  lockstep.AddBus("onboard");
  lockstep.SetTap([&](std::string_view, Time, std::string_view channel, std::span<const std::byte> bytes) {
    if (channel != channels::kWorldTruth.name) return;
    const auto truth = bus::Decode<world_truth_t>(bytes);
    drive = {truth.x_m + 0.475 * std::cos(truth.yaw_rad), truth.contacts};
  });
  const std::string sim = PRIAMOS_SOURCE_DIR "/config/sim/";
  lockstep.AddApp(cli::FactoryFor("world"), "onboard", {sim + "world.toml", {"world=worlds/sill.toml"}});
  lockstep.AddApp(cli::FactoryFor("head"), "onboard",
                  {sim + "head.toml", {"laser.rate_hz=" + std::to_string(laser_hz)}});
  lockstep.AddApp(cli::FactoryFor("robot"), "onboard", {sim + "robot.toml", {}});
  auto paths = lockstep.DriverNode("onboard").Advertise(channels::kPath);
  auto status = lockstep.DriverNode("onboard").Subscribe(channels::kDriveStatus);
  const Time begin = lockstep.now();
  lockstep.RunUntil(begin + FromSeconds(3.5));
  path_t path{};
  path.utime = ToUtime(lockstep.now());
  path.path_id = 1;
  path.estop_changes = status.get()->estop_changes;
  path.speed_m_s = 0.3;
  path.points = {{2.0, 2.4, 0, 0, 0}, {5.0, 2.4, 0, 0, 0}};
  path.n_points = 2;
  paths.Publish(path);
  lockstep.RunUntil(begin + FromSeconds(14));
  return drive;
}

TEST_F(LaserRunTest, TheRobotStopsBeforeADuctThatNoSonarHears) {
  const Drive dut = DriveAtTheDuct(schema_, 5, 2);
  RecordProperty("front", std::to_string(dut.front_m));
  EXPECT_EQ(dut.contacts, 0);
  EXPECT_GT(dut.front_m, 3.0);
  EXPECT_LT(dut.front_m, 3.94);
}

TEST_F(LaserRunTest, WithoutTheLaserItRunsIntoIt) {
  EXPECT_GT(DriveAtTheDuct(schema_, 5, 0).contacts, 0);
}

}  // namespace
}  // namespace priamos
