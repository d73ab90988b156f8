#include "robot/core/sonar/wall_finder.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;

/// A base that drives along a smooth wall 1.5 m to its left; what the sensor abeam hears, and nothing else.
class WallFinderTest : public testing::Test {
 protected:
  /// Drives `metres` with so many metres per cycle; returns the walls found.
  std::vector<WallSeen> Drive(double metres, double step_m = 0.03, Duration cycle = milliseconds(100)) {
    std::vector<WallSeen> found;
    for (double travel = 0; travel < metres; travel += step_m) {
      now_ += cycle;
      base_ = base_ * Pose2{step_m, 0, 0};
      const WallsHeard heard = dut_.Add(Heard(), base_);
      EXPECT_EQ(heard.sensors.count(), heard.walls.size());
      found.insert(found.end(), heard.walls.begin(), heard.walls.end());
    }
    return found;
  }
  SonarCycle Heard() const {
    SonarCycle cycle{now_, {}};
    cycle.range_m.fill(-1);
    const Pose2 at = base_ * BaseFromSonar(kAbeam, {Footprint{}.length_m, Footprint{}.width_m});
    const double wall_m = wall_y_m_ - at.y;
    if (std::abs(WrapAngle(at.yaw - kPi / 2)) < Radians(15)) cycle.range_m[kAbeam] = wall_m;
    return cycle;
  }

  static constexpr int kAbeam = 6;
  WallFinder dut_{WallFinderConfig{}, Footprint{}};
  Pose2 base_;
  double wall_y_m_ = 1.5;
  Time now_ = FromUtime(1'000'000'000);
};

TEST_F(WallFinderTest, AWallIsHeardFromTheLengthOfTheWindowOn) {
  EXPECT_THAT(Drive(0.75), IsEmpty());
  const auto heard = Drive(1.2);
  ASSERT_GE(heard.size(), 35u) << "in every cycle";
  EXPECT_NEAR(heard.back().bearing_rad, kPi / 2, 1e-6);
  EXPECT_NEAR(heard.back().distance_m, 1.5, 1e-6);
}

TEST_F(WallFinderTest, WhereTheWallEndsItIsHeardNoMore) {
  Drive(1.5);
  wall_y_m_ = 1.6;
  EXPECT_LE(Drive(0.6).size(), 1u);
}

TEST_F(WallFinderTest, ABaseThatStandsFindsNothing) {
  Drive(0.3);
  EXPECT_THAT(Drive(3.0, 1e-3), IsEmpty());
}

TEST_F(WallFinderTest, OldRangesAreForgotten) {
  Drive(0.4);
  now_ += std::chrono::seconds(20);
  EXPECT_THAT(Drive(0.4), IsEmpty());
}

TEST_F(WallFinderTest, ASensorThatMovesAlongItsAxisFindsNothing) {
  for (int i = 0; i < 100; ++i) {
    now_ += milliseconds(100);
    base_ = base_ * Pose2{0.03, 0.01, 0};
    SonarCycle cycle{now_, {}};
    cycle.range_m.fill(1.0);
    EXPECT_FALSE(dut_.Add(cycle, base_).sensors[0]) << i;
  }
}

}  // namespace
}  // namespace priamos::robot
