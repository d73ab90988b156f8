#include "head/glances.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"
#include "head/head_app.hpp"
#include "test/head/head_on_a_bench.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using Bench = HeadOnABench<HeadApp>;

constexpr int kLeftAndRight = 3;

HeadConfig Glancing() {
  HeadConfig config;
  config.doors.corridors = true;
  config.doors.zoom_step = config.zoom_step;  // what the bench's table has
  return config;
}

/// A robot that drives, and a path that the radio brought.
class GlancesTest : public testing::Test {
 protected:
  void Drive(Bench& head, double seconds, double speed_m_s = 0.3) {
    for (int i = 0; i < seconds * 50; ++i) {
      pose_t pose{};
      pose.utime = ToUtime(head.clock.Now());
      x_m_ += 0.02 * speed_m_s;
      pose.x_m = x_m_;
      pose.vx_m_s = speed_m_s;
      head.poses.Publish(pose);
      head.Step();
    }
  }
  static void Send(Bench& head, bool centre) {
    auto paths = head.other.Advertise(channels::kPath);
    path_t path{};
    path.utime = ToUtime(head.clock.Now());
    path.centre = centre;
    path.n_points = 1;
    path.points.resize(1);
    paths.Publish(path);
  }
  double x_m_ = 0;
};

TEST_F(GlancesTest, AlongACorridorTheHeadGlancesToBothSides) {
  Bench head(Glancing());
  Send(head, true);
  Drive(head, 3);
  ASSERT_GE(head.triggers.size(), 2u);
  for (const camera_trigger_t& trigger : head.triggers) EXPECT_EQ(trigger.cameras, kLeftAndRight);
  double left = 0, right = 0;
  for (const head_command_t& command : head.commands) {
    left = std::max(left, command.pan_rad);
    right = std::min(right, command.pan_rad);
  }
  EXPECT_NEAR(left, Radians(Glancing().doors.pan_deg), 1e-9);
  EXPECT_NEAR(right, -Radians(Glancing().doors.pan_deg), 0.01);
  EXPECT_TRUE(head.fixes.Drain().empty()) << "nobody has asked";
}

TEST_F(GlancesTest, OnOtherPathsAndAtRestItDoesNot) {
  Bench head(Glancing());
  Drive(head, 2);
  Send(head, false);
  Drive(head, 2);
  EXPECT_TRUE(head.triggers.empty());
  Send(head, true);
  Drive(head, 2, 0);
  EXPECT_TRUE(head.triggers.empty());
  Drive(head, 2);
  EXPECT_FALSE(head.triggers.empty());
}

TEST_F(GlancesTest, ALookIsAnsweredAtOnce) {
  Bench head(Glancing());
  head.cameras_answer = false;  // a glance waits for its pictures
  Send(head, true);
  Drive(head, 1.2);
  ASSERT_FALSE(head.triggers.empty());
  head.cameras_answer = true;
  head.SendLook(7, 3);
  Drive(head, 1);
  const auto fixes = head.fixes.Drain();
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].request_id, 7);
}

TEST_F(GlancesTest, AHandHasTheHead) {
  Bench head(Glancing());
  Send(head, true);
  Drive(head, 1);
  const std::size_t before = head.triggers.size();
  for (int i = 0; i < 100; ++i) {
    head.SendHand(0.2);
    Drive(head, 0.02);
  }
  EXPECT_LE(head.triggers.size(), before + 1);
}

TEST_F(GlancesTest, OnOtherPathsTheHeadLooksAheadIfItIsToldTo) {
  HeadConfig config = Glancing();
  config.scene.ahead = true;
  Bench head(config);
  Drive(head, 2);
  EXPECT_TRUE(head.triggers.empty()) << "no path leads it";
  Send(head, false);
  Drive(head, 4);
  ASSERT_GE(head.triggers.size(), 2u);
  ASSERT_FALSE(head.commands.empty());
  EXPECT_NEAR(head.commands.back().pan_rad, 0, 0.01);
  EXPECT_NEAR(head.commands.back().tilt_rad, Radians(config.scene.tilt_deg), 0.01);
}

TEST(Glances, GlancesWhereTheCamerasAreNotCalibratedAreRefused) {
  HeadConfig config;
  config.doors.corridors = true;
  EXPECT_THAT(support::ThrownReason([&] { Bench head(config); }), testing::HasSubstr("doors.zoom_step"));
}

}  // namespace
}  // namespace priamos::head
