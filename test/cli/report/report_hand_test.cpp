#include "cli/report/report_hand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cli/scenario/free_motion.hpp"
#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

world::Solid Box(double x_m, double y_m, double length_m, double width_m) {
  return {"box", {x_m, y_m, 0}, {length_m, width_m}, 0, 1, "wood"};
}

/// A front wall: its face is `distance_m` before the front of a base at the origin.
TrueWorld WallAhead(double distance_m) {
  return {{}, {Box(0.475 + distance_m + 0.1, 0, 0.2, 40)}};
}

/// A drive made up by hand, without any robot: what was wished, and what the base truly did.
struct SyntheticDrive {
  double seconds = 10;
  Pose2 start{};
  std::function<Twist2(double t_s)> wish, motion;

  RunRecord Record() const {
    RunRecord record;
    Pose2 pose = start;
    for (int i = 0; i < seconds * 50; ++i) {
      const double t_s = i / 50.0;
      const Twist2 twist = motion(t_s), wanted = wish(t_s);
      world_truth_t truth{};
      truth.x_m = pose.x;
      truth.y_m = pose.y;
      truth.yaw_rad = pose.yaw;
      truth.vx_m_s = twist.vx;
      truth.vy_m_s = twist.vy;
      truth.wz_rad_s = twist.wz;
      Feed(record, Side::kOnboard, t_s, "WORLD_TRUTH", truth);
      pose = Integrate(pose, twist, 0.02);
      if (i % 2 != 0) continue;
      drive_command_t command{};
      command.time_to_live_s = 0.2;
      command.vx_m_s = wanted.vx;
      command.vy_m_s = wanted.vy;
      command.wz_rad_s = wanted.wz;
      Feed(record, Side::kOnboard, t_s, "DRIVE_COMMAND", command);
    }
    return record;
  }
};

DoorPlan PassageAt(double x_m) {
  DoorPlan passage;
  passage.x_m = x_m;
  passage.opening_width_m = 1.2;
  return passage;
}

std::function<Twist2(double)> Always(const Twist2& twist) {
  return [twist](double) { return twist; };
}

std::optional<double> HonouredIn(const TrueWorld& world, const SyntheticDrive& drive) {
  const auto dut = HandSummaryOf(drive.Record(), world, PassageAt(50));
  EXPECT_TRUE(dut);
  return dut ? dut->honoured() : std::nullopt;
}

TEST(ReportHand, WithoutAnOperatorThereIsNothingToHonour) {
  EXPECT_FALSE(HandSummaryOf(RunRecord(), {}, {}));
  EXPECT_FALSE(HandSummaryOf(SyntheticDrive{.wish = Always({}), .motion = Always({})}.Record(), {}, {}));
}

TEST(ReportHand, StandingWhereThereIsRoomIsNotHonoured) {
  const auto dut = HonouredIn({}, {.wish = Always({0.5, 0, 0}), .motion = Always({})});
  ASSERT_TRUE(dut);
  EXPECT_LT(*dut, 0.01);
}

TEST(ReportHand, StandingBeforeACartonBesideWhichTheWishIsFreeIsNotHonoured) {
  const TrueWorld carton{{}, {Box(0.475 + 0.122 + 0.2, -0.4, 0.4, 0.4)}};
  const auto dut = HonouredIn(carton, {.wish = Always({0.47, 0.17, 0}), .motion = Always({})});
  ASSERT_TRUE(dut);
  EXPECT_LT(*dut, 0.01);
}

TEST(ReportHand, StandingForHalfTheTimeCountsByTime) {
  const auto dut = HonouredIn({}, {.seconds = 40, .wish = Always({0.4, 0, 0}), .motion = [](double t_s) {
                                     return Twist2{t_s < 20 ? 0.4 : 0, 0, 0};
                                   }});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(*dut, 0.5, 0.02);
}

TEST(ReportHand, PushingIntoAWallIsNotCounted) {
  EXPECT_FALSE(HonouredIn(WallAhead(0.19), {.wish = Always({0.5, 0, 0}), .motion = Always({})}));
}

TEST(ReportHand, SlidingAlongAWallIsAllThatWasFree) {
  const auto dut =
      HonouredIn(WallAhead(0.065), {.wish = Always({0.4, 0.3, 0}), .motion = Always({0, 0.3, 0})});
  ASSERT_TRUE(dut);
  EXPECT_GT(*dut, 0.95);
}

TEST(ReportHand, MotionAgainstTheWishAchievesNothing) {
  const auto dut = HonouredIn({}, {.wish = Always({0.4, 0, 0}), .motion = Always({-0.4, 0, 0})});
  ASSERT_TRUE(dut);
  EXPECT_LT(*dut, 0.01);
}

TEST(ReportHand, ANormalDriveIsHonouredThroughItsAcceleration) {
  const auto dut = HonouredIn({}, {.wish = Always({0.6, 0, 0}), .motion = [](double t_s) {
                                     return Twist2{std::min(0.6, 0.8 * std::max(0.0, t_s - 0.1)), 0, 0};
                                   }});
  ASSERT_TRUE(dut);
  EXPECT_GT(*dut, 0.97);
}

TEST(ReportHand, TheBaseMayFollowTheHandATenthOfASecondLater) {
  const auto pushes = [](double t_s) { return Twist2{std::fmod(t_s + 1e-6, 0.8) < 0.4 ? 0.4 : 0, 0, 0}; };
  const auto dut = HonouredIn(
      {}, {.wish = pushes, .motion = [&](double t_s) { return t_s < 0.1 ? Twist2{} : pushes(t_s - 0.1); }});
  ASSERT_TRUE(dut);
  EXPECT_GT(*dut, 0.97);
}

TEST(ReportHand, ALongStopInThePassageIsAFault) {
  SyntheticDrive drive{.wish = Always({0.4, 0, 0}), .motion = [](double t_s) {
                         return Twist2{t_s > 2 && t_s < 5 ? 0 : 0.4, 0, 0};
                       }};
  const auto dut = HandSummaryOf(drive.Record(), {}, PassageAt(1));
  ASSERT_TRUE(dut && dut->longest_stop_s);
  EXPECT_NEAR(*dut->longest_stop_s, 3, 0.05);
  EXPECT_EQ(FaultOf(*dut, 2), "stood in the passage for 3.0 s while the operator pushed, 2.0 s are allowed");
  EXPECT_EQ(FaultOf(*dut, 4), "");
  EXPECT_EQ(FaultOf(*dut, 0), "") << "no limit";
}

TEST(ReportHand, AStopThatWasWishedOrIsElsewhereIsNone) {
  const auto stops = [](double t_s) { return Twist2{t_s > 2 && t_s < 5 ? 0 : 0.4, 0, 0}; };
  const SyntheticDrive rested{.wish = stops, .motion = stops};
  EXPECT_LT(*HandSummaryOf(rested.Record(), {}, PassageAt(1))->longest_stop_s, 0.5);
  const SyntheticDrive elsewhere{.wish = Always({0.4, 0, 0}), .motion = stops};
  EXPECT_FALSE(HandSummaryOf(elsewhere.Record(), {}, PassageAt(50))->longest_stop_s);
}

TEST(ReportHand, AStopBesideThePassageIsNone) {
  const SyntheticDrive beside{.start = {1, 0.7, 0}, .wish = Always({0.4, 0, 0}), .motion = Always({})};
  EXPECT_FALSE(HandSummaryOf(beside.Record(), {}, PassageAt(1))->longest_stop_s);
}

TEST(FreeMotion, KeepsItsMarginsBesideAndAhead) {
  const FreeMotion beside({{}, {Box(0, 0.39 + 0.05 + 0.1, 20, 0.2)}});
  EXPECT_NEAR(beside.Of({}, {0.5, 0, 0}).vx, 0.5, 1e-9) << "along a wall 5 cm beside";
  EXPECT_NEAR(beside.Of({}, {0, 0.5, 0}).vy, 0, 1e-9) << "into it";
  EXPECT_NEAR(beside.Of({}, {0, -0.5, 0}).vy, -0.5, 1e-9) << "away from it";
  EXPECT_NEAR(FreeMotion(WallAhead(0.2)).Of({}, {0.5, 0, 0}).vx, 0, 0.02);
  const double v = FreeMotion(WallAhead(0.4)).Of({}, {0.6, 0, 0}).vx;
  EXPECT_NEAR(v * 0.2 + v * v / 2, 0.2, 0.01) << "stands 20 cm before";
}

TEST(FreeMotion, LooksAtTheRectangleAndNotAtACircle) {
  const FreeMotion dut({{}, {Box(0, 1.5, 20, 0.2)}});
  EXPECT_GT(dut.Of({0, 0.73, 0}, {0, 0.5, 0}).vy, 0.05) << "with its narrow side";
  EXPECT_NEAR(dut.Of({0, 0.73, Radians(90)}, {0.5, 0, 0}).vx, 0, 1e-9) << "with its long side";
}

}  // namespace
}  // namespace priamos::cli
