#include "head/core/landmark/pose_history.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace priamos::head {
namespace {

using std::chrono::milliseconds;

PoseSample Sample(int ms, double x) {
  return {Time(milliseconds(ms)), {x, 0, 0}, {0.5, 0, 0}, Eigen::Matrix3d::Identity()};
}

TEST(PoseHistoryTest, IsEmptyAtFirst) {
  EXPECT_FALSE(PoseHistory().At(Time(milliseconds(0))));
}

TEST(PoseHistoryTest, CarriesThePoseToTheTimeOfTheExposure) {
  PoseHistory dut;
  for (int i = 0; i <= 10; ++i) dut.Add(Sample(1000 + 20 * i, 0.01 * i));
  const auto pose = dut.At(Time(milliseconds(1070)));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->map_from_base.x, 0.035, 1e-9);
}

TEST(PoseHistoryTest, DoesNotBlendAcrossACorrection) {
  PoseHistory dut;
  dut.Add(Sample(1000, 0));
  dut.Add(Sample(1020, 0.3));  // a fix was applied here
  EXPECT_NEAR(dut.At(Time(milliseconds(1010)))->map_from_base.x, 0.005, 1e-9);
}

TEST(PoseHistoryTest, ReachesALittleBeyondTheNewest) {
  PoseHistory dut;
  dut.Add(Sample(1000, 0));
  EXPECT_NEAR(dut.At(Time(milliseconds(1100)))->map_from_base.x, 0.05, 1e-9);
  EXPECT_TRUE(dut.At(Time(milliseconds(1300))));
  EXPECT_FALSE(dut.At(Time(milliseconds(1301))));
  EXPECT_FALSE(dut.At(Time(milliseconds(999))));
}

TEST(PoseHistoryTest, ForgetsOldPoses) {
  PoseHistory dut;
  for (int i = 0; i < 500; ++i) dut.Add(Sample(20 * i, 0));
  EXPECT_FALSE(dut.At(Time(milliseconds(5000))));
  EXPECT_TRUE(dut.At(Time(milliseconds(8000))));
}

TEST(PoseHistoryTest, StartsAnewWhenTheRobotWasRestarted) {
  PoseHistory dut;
  dut.Add(Sample(100000, 0));
  dut.Add(Sample(1000, 7));
  ASSERT_TRUE(dut.At(Time(milliseconds(1000))));
  EXPECT_DOUBLE_EQ(dut.At(Time(milliseconds(1000)))->map_from_base.x, 7);
}

TEST(PoseHistoryTest, PredictionCarriesTheCovarianceIntoTheRobotsFrame) {
  // Against samples: the landmark seen from robots scattered with the covariance.
  Eigen::Matrix3d root;
  root << 0.05, 0, 0, 0.01, 0.03, 0, 0.002, 0.01, 0.02;
  const PoseSample robot{Time{}, {1, 2, 0.7}, {}, root * root.transpose()};
  const Pose2 map_from_landmark{3, 4, 0.2};
  const LandmarkPrediction dut = Predict(robot, map_from_landmark);
  Rng rng(3);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  constexpr int kN = 20000;
  for (int i = 0; i < kN; ++i) {
    const Eigen::Vector3d e = root * Eigen::Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1));
    const Pose2 there{1 + e.x(), 2 + e.y(), 0.7 + e.z()};
    const Pose2 seen = there.Inverse() * map_from_landmark;
    const Eigen::Vector3d d(seen.x - dut.base_from_landmark.x, seen.y - dut.base_from_landmark.y,
                            WrapAngle(seen.yaw - dut.base_from_landmark.yaw));
    scatter += d * d.transpose() / kN;
  }
  EXPECT_LT((scatter - dut.covariance).norm(), 0.05 * dut.covariance.norm());
}

}  // namespace
}  // namespace priamos::head
