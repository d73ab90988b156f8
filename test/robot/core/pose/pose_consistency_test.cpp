// Is the covariance honest? The normalised estimation error squared (NEES: Bar-Shalom, Li and Kirubarajan,
// "Estimation with Applications to Tracking and Navigation", section 5.4) of a three-dimensional estimate is
// 3 on average; above, the estimator claims too much, below, it knows more than it says.

#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "common/random.hpp"
#include "robot/core/pose/pose_estimator.hpp"
#include "test/robot/support/simulated_base.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

constexpr int kRuns = 400;
const Pose2 kDoor{6, 2.4, 0};

double Nees(const PoseEstimate& estimate, const Pose2& truth) {
  const Eigen::Vector3d error(estimate.pose.x - truth.x, estimate.pose.y - truth.y,
                              WrapAngle(estimate.pose.yaw - truth.yaw));
  return error.dot(estimate.covariance.inverse() * error);
}

/// A measurement whose error really has the covariance it claims, with correlations.
LandmarkFix NoisyFix(Time exposure, int id, const Pose2& truth, Rng& rng) {
  Eigen::Matrix3d root;
  root << 0.02, 0, 0, 0.004, 0.01, 0, 0.001, 0.004, 0.006;
  const Eigen::Vector3d error = root * Eigen::Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1));
  Pose2 seen = truth.Inverse() * kDoor;
  seen = {seen.x + error.x(), seen.y + error.y(), WrapAngle(seen.yaw + error.z())};
  return {exposure, id, seen, root * root.transpose(), kDoor};
}

struct Mean {
  double start = 0, driven = 0, fixed = 0, door = 0;
};

/// Drives 3 m towards the door with a bend; two fixes, the second one 0.4 s late.
Mean MeanNees(int first_seed) {
  Mean mean;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng = Rng::Stream(static_cast<std::uint64_t>(first_seed + run), "consistency");
    const Pose2 start{2 + rng.Uniform(-0.2, 0.2), 2.4 + rng.Uniform(-0.2, 0.2), Radians(rng.Uniform(-5, 5))};
    SimulatedBase base(static_cast<std::uint64_t>(first_seed + run), start);
    Odometry odometry({}, {});
    PoseEstimatorConfig config;
    config.initial = {.x_m = 2, .y_m = 2.4};
    PoseEstimator dut(config);
    Pose2 seen_from;
    Time seen_at{};
    for (int tick = 0; tick < 450; ++tick) {
      const double wz = tick < 150 ? 0.15 : -0.15;
      base.Command(ToWheelSpeeds({}, {0.35, tick < 250 ? 0.1 : -0.05, wz}), base.now());
      base.Advance(milliseconds(20));
      if (const auto step = odometry.Add(base.Read(), base.now())) dut.Move(*step);
      if (tick == 2) mean.start += Nees(*dut.newest(), base.truth());
      if (tick == 100) {
        mean.driven += Nees(*dut.newest(), base.truth());
        dut.Apply(NoisyFix(base.now(), 1, base.truth(), rng));
      }
      if (tick == 180) {
        seen_from = base.truth();
        seen_at = base.now();
      }
      if (tick == 200) {
        dut.Apply(NoisyFix(seen_at, 2, seen_from, rng));
        mean.fixed += Nees(*dut.newest(), base.truth());
      }
    }
    mean.door += Nees(*dut.newest(), base.truth());
  }
  return {mean.start / kRuns, mean.driven / kRuns, mean.fixed / kRuns, mean.door / kRuns};
}

TEST(PoseConsistency, TheErrorIsAsLargeAsTheCovarianceSays) {
  const Mean mean = MeanNees(1);
  RecordProperty("start", std::to_string(mean.start));
  RecordProperty("driven", std::to_string(mean.driven));
  RecordProperty("fixed", std::to_string(mean.fixed));
  RecordProperty("door", std::to_string(mean.door));
  // 400 runs of chi square with 3 degrees of freedom: mean 3, standard deviation sqrt(6 / 400) = 0.12. Below
  // 3 because slip that is forgotten after 0.3 m adds up to less than the random walk that stands for it.
  for (const double nees : {mean.start, mean.driven, mean.fixed, mean.door}) {
    EXPECT_LT(nees, 3.4);
    EXPECT_GT(nees, 1.6);
  }
}

/// A head that is calibrated wrongly and a door that stands elsewhere: every look has the same error, seen
/// from where the robot is, and little of its own.
double NeesAfterLooks(int looks, double own_share_told) {
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    Rng rng = Rng::Stream(static_cast<std::uint64_t>(run), "repeated looks");
    const Pose2 head_error{rng.Normal(0.002), rng.Normal(0.002), rng.Normal(0.002)};
    const Pose2 door_error{rng.Normal(0.003), rng.Normal(0.003), rng.Normal(0.002)};
    Pose2 truth{2 + rng.Uniform(-0.2, 0.2), 2.4 + rng.Uniform(-0.2, 0.2), Radians(rng.Uniform(-5, 5))};
    PoseEstimatorConfig config;
    config.initial = {.x_m = 2, .y_m = 2.4};
    config.bias = {1e-6, 1e-6, 1e-6, 1e-6, 1e-6};
    PoseEstimator dut(config);
    Time now = FromUtime(1'000'000);
    for (int look = 0; look < looks; ++look) {
      const Twist2 twist{0.6, 0.1 - 0.05 * look, 0.05};
      dut.Move({.from = now, .to = now + milliseconds(500), .twist = twist});
      now += milliseconds(500);
      truth = Integrate(truth, twist, 0.5);
      const Pose2 seen = head_error * (truth.Inverse() * (kDoor * door_error));
      // What such errors make of a fix from here.
      Eigen::Matrix3d by_head = Eigen::Matrix3d::Identity();
      by_head.topRightCorner<2, 1>() << -seen.y, seen.x;
      const Eigen::Matrix3d covariance =
          by_head * Eigen::Vector3d(4e-6, 4e-6, 4e-6).asDiagonal() * by_head.transpose() +
          Eigen::Matrix3d(Eigen::Vector3d(9e-6, 9e-6, 4e-6).asDiagonal());
      EXPECT_EQ(dut.Apply({now, look, seen, covariance, kDoor, own_share_told}).verdict,
                FixVerdict::kApplied);
    }
    sum += Nees(*dut.newest(), truth) / kRuns;
  }
  return sum;
}

TEST(PoseConsistency, LooksAtOneDoorDoNotPretendToBeIndependent) {
  EXPECT_GT(NeesAfterLooks(5, 1), 9) << "this test shows nothing";
  for (const int looks : {1, 2, 5}) {
    const double nees = NeesAfterLooks(looks, 0);
    EXPECT_GT(nees, 1.9) << looks;
    EXPECT_LT(nees, 3.6) << looks;
  }
}

}  // namespace
}  // namespace priamos::robot
