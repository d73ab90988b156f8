#include "robot/core/pose/landmark_correction.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

namespace priamos::robot {
namespace {

Pose2 AnyPose(double reach_m) {
  const auto part = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  return {part() * reach_m, part() * reach_m, part() * 3.1};
}

TEST(LandmarkCorrection, IsNothingWhenTheLandmarkIsSeenWhereItIsExpected) {
  const Pose2 base{1, 2, 0.3}, landmark{4, 2.5, 0.1};
  const LandmarkCorrection dut = CorrectionFrom(base, base.Inverse() * landmark, landmark);
  EXPECT_NEAR(dut.rotation_rad, 0, 1e-12);
  EXPECT_NEAR(dut.displacement_m.norm(), 0, 1e-12);
}

TEST(LandmarkCorrection, ADoorSeenTooFarAwayMovesTheEstimateBack) {
  // The door stands 3 m ahead on the map and is seen at 3.2 m: the robot is 0.2 m further back.
  const LandmarkCorrection dut = CorrectionFrom({0, 0, 0}, {3.2, 0, 0}, {3, 0, 0});
  EXPECT_NEAR(dut.displacement_m.x(), 0.2, 1e-12);
  EXPECT_NEAR(Corrected({0, 0, 0}, dut).x, -0.2, 1e-12);
}

TEST(LandmarkCorrection, ADoorSeenTurnedToTheRightTurnsTheEstimateToTheLeft) {
  const LandmarkCorrection dut = CorrectionFrom({0, 0, 0}, {3, 0, -0.05}, {3, 0, 0});
  EXPECT_NEAR(dut.rotation_rad, 0.05, 1e-12);
}

TEST(LandmarkCorrection, EquationsEightAndNineGiveThePoseFromWhichTheLandmarkLooksSo) {
  EXPECT_TRUE(rc::check([] {
    const Pose2 truth = AnyPose(10), estimate = AnyPose(10), landmark = AnyPose(10);
    const Pose2 pose = Corrected(estimate, CorrectionFrom(estimate, truth.Inverse() * landmark, landmark));
    RC_ASSERT((pose.translation() - truth.translation()).norm() < 1e-9);
    RC_ASSERT(std::abs(WrapAngle(pose.yaw - truth.yaw)) < 1e-9);
  }));
}

TEST(LandmarkCorrection, TheDerivativeOfTheExpectedSightIsTheDifferenceQuotient) {
  EXPECT_TRUE(rc::check([] {
    const Pose2 pose = AnyPose(5), landmark = AnyPose(5);
    const ExpectedMeasurement dut = PredictMeasurement(pose, landmark);
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 3; ++i) {
      Pose2 moved = pose;
      (i == 0 ? moved.x : i == 1 ? moved.y : moved.yaw) += kStep;
      const Pose2 seen = PredictMeasurement(moved, landmark).base_from_landmark;
      const Eigen::Vector3d quotient =
          Eigen::Vector3d(seen.x - dut.base_from_landmark.x, seen.y - dut.base_from_landmark.y,
                          WrapAngle(seen.yaw - dut.base_from_landmark.yaw)) /
          kStep;
      RC_ASSERT((quotient - dut.by_pose.col(i)).norm() < 1e-4);
    }
  }));
}

}  // namespace
}  // namespace priamos::robot
