#include "robot/core/pose/localiser.hpp"

#include <gmock/gmock.h>

#include "test/robot/support/simulated_base.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::SizeIs;

const Pose2 kDoor{6, 0, 0};

class LocaliserTest : public testing::Test {
 protected:
  void Drive(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      base_.Command(ToWheelSpeeds({}, {0.3, 0, 0}), base_.now());
      base_.Advance(milliseconds(20));
      EXPECT_TRUE(dut_.AddWheels(base_.Read(), base_.now()));
    }
  }
  LandmarkFix Fix(Time exposure, int id) const {
    return {exposure, id, base_.truth().Inverse() * kDoor, Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal(),
            kDoor};
  }

  SimulatedBase base_{1, {0.1, -0.1, 0.05}};
  Localiser dut_{LocaliserConfig{}, MecanumGeometry{}, Footprint{}};
};

TEST_F(LocaliserTest, HasNoEstimateBeforeTheWheelsHaveSpokenTwice) {
  Drive(1);
  EXPECT_FALSE(dut_.estimate());
  Drive(1);
  EXPECT_TRUE(dut_.estimate());
}

TEST_F(LocaliserTest, AFixIsAnsweredOnceAndMovesTheEstimateToTheTruth) {
  Drive(50);
  dut_.AddFix(Fix(base_.now(), 7), base_.now());
  const auto answers = dut_.Step(base_.now());
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_EQ(answers[0].fix.request_id, 7);
  EXPECT_EQ(answers[0].result.verdict, FixVerdict::kApplied);
  EXPECT_NEAR(dut_.estimate()->pose.y, base_.truth().y, 0.01);
  EXPECT_THAT(dut_.Step(base_.now()), IsEmpty());
}

TEST_F(LocaliserTest, AFixFromBetweenTheLastAndTheNextSampleWaits) {
  Drive(50);
  dut_.AddFix(Fix(base_.now() + milliseconds(10), 7), base_.now() + milliseconds(15));
  EXPECT_THAT(dut_.Step(base_.now() + milliseconds(15)), IsEmpty());
  Drive(1);
  EXPECT_EQ(dut_.Step(base_.now()).at(0).result.verdict, FixVerdict::kApplied);
}

TEST_F(LocaliserTest, AFixFromTheFarFutureIsGivenUp) {
  Drive(50);
  dut_.AddFix(Fix(base_.now() + milliseconds(60'000), 7), base_.now());
  Drive(30);
  EXPECT_EQ(dut_.Step(base_.now()).at(0).result.verdict, FixVerdict::kTooNew);
}

TEST_F(LocaliserTest, AFloodOfFixesFromTheFutureDoesNotGrow) {
  Drive(50);
  for (int i = 0; i < 10'000; ++i) dut_.AddFix(Fix(base_.now() + milliseconds(60'000), i), base_.now());
  Drive(30);
  EXPECT_LE(dut_.Step(base_.now()).size(), 16u);
}

TEST_F(LocaliserTest, TheOdometryPoseOfAnExposureLiesWhereTheBaseWasThen) {
  const auto turn = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      base_.Command(ToWheelSpeeds({}, {0.3, 0.1, 0.2}), base_.now());
      base_.Advance(milliseconds(20));
      dut_.AddWheels(base_.Read(), base_.now());
    }
  };
  turn(100);
  const Time exposure = base_.now();
  const Pose2 then = dut_.odometry().pose();
  turn(25);
  const Pose2 dut = dut_.OdometryPoseAt(exposure);
  EXPECT_GT((dut_.odometry().pose().translation() - then.translation()).norm(), 0.1);
  EXPECT_NEAR(dut.x, then.x, 0.01);
  EXPECT_NEAR(dut.y, then.y, 0.01);
  EXPECT_NEAR(dut.yaw, then.yaw, 0.01);
}

TEST_F(LocaliserTest, TheOdometryPoseOfATimeToComeIsTheNewestOne) {
  Drive(50);
  const Pose2 dut = dut_.OdometryPoseAt(base_.now() + milliseconds(500)), newest = dut_.odometry().pose();
  EXPECT_GT(newest.x, 0.1);
  EXPECT_DOUBLE_EQ(dut.x, newest.x);
  EXPECT_DOUBLE_EQ(dut.y, newest.y);
}

TEST_F(LocaliserTest, AnExposureOfLongAgoIsFollowedBackForFiveSecondsOnly) {
  Drive(50);
  const auto x_ago = [&](int ms) { return dut_.OdometryPoseAt(base_.now() - milliseconds(ms)).x; };
  EXPECT_DOUBLE_EQ(x_ago(60'000), x_ago(5'000));
  EXPECT_GT(x_ago(4'900), x_ago(5'000) + 0.01);
}

TEST_F(LocaliserTest, SlipWidensThePoseOnceWithTheNextSample) {
  Drive(50);
  const auto variance = [&] { return dut_.estimate()->covariance(0, 0); };
  const double before = variance();
  dut_.AddSlip(0.3, Radians(2));
  EXPECT_EQ(variance(), before);
  Drive(1);
  EXPECT_NEAR(variance(), before + 0.09, 0.001);
  Drive(1);
  EXPECT_NEAR(variance(), before + 0.09, 0.001) << "once";
}

TEST_F(LocaliserTest, BeforeTheFirstSampleTheBaseHasNotMoved) {
  const Pose2 dut = dut_.OdometryPoseAt(base_.now() - milliseconds(100));
  EXPECT_EQ(dut.x, 0);
  EXPECT_EQ(dut.y, 0);
  EXPECT_EQ(dut.yaw, 0);
}

}  // namespace
}  // namespace priamos::robot
