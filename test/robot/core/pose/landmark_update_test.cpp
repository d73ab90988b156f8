#include "robot/core/pose/landmark_update.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using Vector = PoseState::Vector;

PoseState SomeState() {
  PoseState state;
  state.mean << 1, 2, 0.7, 0.01, -0.02, 0.01, 0.004, -0.003, 0.006, 0.01, -0.005;
  Vector sigma(PoseState::kOwn);
  sigma << 0.1, 0.12, 0.05, 0.01, 0.02, 0.01, 0.004, 0.003, 0.006, 0.01, 0.005;
  state.covariance = sigma.cwiseAbs2().asDiagonal();
  return state;
}

OdometryStep SomeStep(Duration time = milliseconds(200)) {
  return {.from = FromUtime(0), .to = FromUtime(0) + time, .twist = {0.4, -0.2, 0.6}};
}

TEST(Updated, AnExactSightOutweighsTheEstimate) {
  const PoseState prior = SomeState();
  const Pose2 truth{1.08, 1.95, 0.75}, landmark{4, 3, 0.2};
  const MeasurementUpdate dut =
      Updated(prior, {truth.Inverse() * landmark, Eigen::Matrix3d::Identity() * 1e-10, landmark});
  EXPECT_NEAR(dut.state.mean(0), truth.x, 1e-5);
  EXPECT_NEAR(dut.state.mean(1), truth.y, 1e-5);
  EXPECT_NEAR(dut.state.mean(2), truth.yaw, 1e-5);
}

TEST(Updated, AVagueSightChangesLittle) {
  const PoseState prior = SomeState();
  const Pose2 truth{1.08, 1.95, 0.75}, landmark{4, 3, 0.2};
  const MeasurementUpdate dut =
      Updated(prior, {truth.Inverse() * landmark, Eigen::Matrix3d::Identity() * 1e4, landmark});
  EXPECT_LT((dut.state.mean - prior.mean).norm(), 1e-4);
  EXPECT_NEAR(dut.state.covariance(0, 0) / prior.covariance(0, 0), 1, 1e-3);
}

TEST(Updated, FindsTheMostProbablePoseThoughTheHeadingIsFarOff) {
  const PoseState prior = SomeState();
  const Pose2 truth{1.15, 1.9, 0.84}, landmark{5, 3, 0.2};
  const Eigen::Matrix3d covariance = Eigen::Vector3d(4e-4, 1e-4, 1e-3).asDiagonal();
  const Pose2 seen = truth.Inverse() * landmark;
  const Eigen::Matrix3d prior_information = prior.pose_covariance().inverse();
  const auto cost = [&](const Pose2& pose) {
    const Pose2 expected = pose.Inverse() * landmark;
    const Eigen::Vector3d r(seen.x - expected.x, seen.y - expected.y, WrapAngle(seen.yaw - expected.yaw));
    const Eigen::Vector3d d(pose.x - prior.mean(0), pose.y - prior.mean(1), pose.yaw - prior.mean(2));
    return d.dot(prior_information * d) + r.dot(covariance.inverse() * r);
  };
  const MeasurementUpdate dut = Updated(prior, {seen, covariance, landmark});
  const Pose2 best = dut.state.pose();
  EXPECT_NEAR(dut.distance * dut.distance, cost(best), 1e-3);
  for (const Pose2& step : {Pose2{1e-3, 0, 0}, Pose2{0, 1e-3, 0}, Pose2{0, 0, 1e-3}}) {
    EXPECT_GT(cost({best.x + step.x, best.y + step.y, best.yaw + step.yaw}), cost(best));
    EXPECT_GT(cost({best.x - step.x, best.y - step.y, best.yaw - step.yaw}), cost(best));
  }
}

TEST(Updated, LeavesASymmetricPositiveCovariance) {
  const Pose2 landmark{5, 3, 0.2};
  const MeasurementUpdate dut =
      Updated(SomeState(), {{3.5, -1.5, -0.5}, Eigen::Vector3d(1e-6, 1e-6, 1e-8).asDiagonal(), landmark});
  EXPECT_LT((dut.state.covariance - dut.state.covariance.transpose()).norm(), 1e-12);
  EXPECT_GT(dut.state.covariance.ldlt().vectorD().minCoeff(), 0);
}

const Pose2 kHere{1.15, 1.9, 0.84}, kLandmark{5, 3, 0.2};

LandmarkMeasurement SomeSight(double own_share) {
  Eigen::Matrix3d root;
  root << 0.02, 0, 0, 0.004, 0.01, 0, 0.001, 0.004, 0.006;
  return {kHere.Inverse() * kLandmark, root * root.transpose(), kLandmark, own_share};
}

TEST(RepeatedSights, TellNoMoreThanOne) {
  const LandmarkMeasurement measurement = SomeSight(0);
  PoseState dut = Updated(SomeState(), measurement).state;
  const Eigen::Matrix3d once = dut.pose_covariance();
  for (int i = 0; i < 4; ++i) dut = Updated(dut, measurement).state;
  EXPECT_GT(dut.pose_covariance().determinant(), 0.97 * once.determinant());
}

TEST(RepeatedSights, CountInFullAsFarAsTheyAreIndependent) {
  const PoseState first = Updated(SomeState(), SomeSight(1)).state;
  EXPECT_LT(first.repeated.norm(), 1e-15);
  const Eigen::Matrix3d twice = Updated(first, SomeSight(1)).state.pose_covariance();
  EXPECT_LT(twice(0, 0), 0.6 * first.covariance(0, 0));
  const PoseState half = Updated(SomeState(), SomeSight(0.5)).state;
  const Eigen::Matrix3d shared = Updated(half, SomeSight(0.5)).state.pose_covariance();
  EXPECT_GT(shared.determinant(), 1.5 * twice.determinant());
  EXPECT_LT(shared.determinant(), 0.9 * half.pose_covariance().determinant());
}

TEST(RepeatedSights, ABetterOneOutweighsAWorseOne) {
  LandmarkMeasurement vague = SomeSight(0), sharp = SomeSight(0);
  vague.covariance *= 25;
  const PoseState dut = Updated(Updated(SomeState(), vague).state, sharp).state;
  const PoseState alone = Updated(SomeState(), sharp).state;
  EXPECT_LT(dut.pose_covariance().determinant(), 1.2 * alone.pose_covariance().determinant());
}

TEST(RepeatedSights, LeaveBothPartsOfTheCovariancePositive) {
  PoseState dut = SomeState();
  for (int i = 0; i < 20; ++i) {
    dut = Updated(Propagated(dut, SomeStep()), SomeSight(0.02)).state;
    for (const PoseState::Matrix& part : {dut.repeated, PoseState::Matrix(dut.covariance - dut.repeated)}) {
      EXPECT_LT((part - part.transpose()).norm(), 1e-12);
      EXPECT_GT(part.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
    }
  }
}

}  // namespace
}  // namespace priamos::robot
