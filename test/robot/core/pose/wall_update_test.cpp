#include "robot/core/pose/wall_update.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

const Pose2 kSonar{0, 0.39, kPi / 2};

/// At (1, 2, 0.1), two walls: to the left and to the right.
PoseState SomeState() {
  PoseState state;
  state.mean.head<3>() << 1, 2, 0.1;
  PoseState::Vector sigma(PoseState::kOwn);
  sigma << 0.02, 0.03, 0.02, 0.01, 0.02, 0.01, 0.004, 0.003, 1e-4, 1e-4, 1e-4;
  state.covariance = sigma.cwiseAbs2().asDiagonal();
  state.repeated = 0.3 * state.covariance;
  return state;
}

WallSeen Seen(double bearing_rad, double distance_m) {
  return {bearing_rad, distance_m, Eigen::Vector2d(1e-4, 4e-5).asDiagonal()};
}

PoseState WithTwoWalls() {
  return WithWall(WithWall(SomeState(), Seen(kPi / 2, 2.0)), Seen(-kPi / 2 + 0.02, 1.5));
}

double Expected(const PoseState& state, int wall, const Pose2& base_from_sonar) {
  const WallLine line = WallOf(state, wall);
  return line.distance_m - line.normal().dot((state.pose() * base_from_sonar).translation() - line.anchor);
}

TEST(WallUpdate, ANewWallLiesWhereItWasSeenAndMovesWithThePose) {
  const PoseState dut = WithTwoWalls();
  ASSERT_EQ(dut.walls(), 2);
  EXPECT_NEAR(WallOf(dut, 0).angle_rad, 0.1 + kPi / 2, 1e-12);
  EXPECT_NEAR(Expected(dut, 0, kSonar), 2.0 - 0.39, 1e-12);
  // Who turns the pose turns the wall as much: they are known relative to each other.
  constexpr int kAngle = PoseState::kOwn;
  EXPECT_NEAR(dut.covariance(2, kAngle), dut.covariance(2, 2), 1e-12);
  const double angle_between =
      dut.covariance(2, 2) + dut.covariance(kAngle, kAngle) - 2 * dut.covariance(2, kAngle);
  EXPECT_NEAR(angle_between, 1e-4, 1e-12);
  EXPECT_GT(dut.covariance.ldlt().vectorD().minCoeff(), 0);
}

TEST(WallUpdate, AWallThatIsGivenUpLeavesTheRestAsItWas) {
  const PoseState both = WithTwoWalls();
  const PoseState dut = WithoutWall(both, 0);
  ASSERT_EQ(dut.walls(), 1);
  EXPECT_EQ(WallOf(dut, 0).angle_rad, WallOf(both, 1).angle_rad);
  EXPECT_EQ(WallOf(dut, 0).anchor, WallOf(both, 1).anchor);
  EXPECT_EQ((dut.covariance.topLeftCorner<PoseState::kOwn, PoseState::kOwn>()),
            (both.covariance.topLeftCorner<PoseState::kOwn, PoseState::kOwn>()));
  EXPECT_EQ((dut.covariance.bottomRightCorner<2, 2>()), (both.covariance.bottomRightCorner<2, 2>()));
  EXPECT_EQ((dut.covariance.topRightCorner<PoseState::kOwn, 2>()),
            (both.covariance.topRightCorner<PoseState::kOwn, 2>()));
}

/// The gain of an update is prior * h' / spread, so that two updates show h.
RC_GTEST_PROP(WallUpdate, TheDerivativeIsTheDifferenceQuotient, ()) {
  PoseState state = WithTwoWalls();
  for (int i = 0; i < state.size(); ++i) state.mean(i) += *rc::gen::inRange(-100, 101) / 2000.0;
  state.covariance.setIdentity();
  state.repeated.setZero();
  const int wall = *rc::gen::inRange(0, 2);
  constexpr double kStep = 1e-6, kResidual = 1e-3, kSigma = 100;
  const double expected = Expected(state, wall, kSonar);
  const RangeUpdate dut = Updated(state, wall, {kSonar, expected + kResidual, kSigma});
  for (int i = 0; i < state.size(); ++i) {
    PoseState moved = state;
    moved.mean(i) += kStep;
    const double h = (Expected(moved, wall, kSonar) - expected) / kStep;
    const double by_update = (dut.state.mean(i) - state.mean(i)) / kResidual * (kSigma * kSigma + 5);
    RC_ASSERT(std::abs(by_update - h) < 0.01 * (1 + std::abs(h)));
  }
}

TEST(WallUpdate, RangesAlongAWallHoldTheHeading) {
  Rng rng(7);
  PoseState dut = SomeState();
  dut.covariance(2, 2) = 1e-8;
  dut = WithWall(dut, Seen(kPi / 2 - 0.1, 2.0));
  Pose2 truth{1, 2, 0.1};
  const Twist2 twist{0.3, 0, 0};
  for (int i = 0; i < 100; ++i) {
    OdometryStep step{.from = FromUtime(0), .to = FromUtime(100'000), .twist = twist};
    step.noise.diagonal() << 1e-6, 1e-6, 3e-6;
    truth = Integrate(truth, {0.3, 0, rng.Normal(std::sqrt(3e-6)) / 0.1}, 0.1);
    dut = Propagated(dut, step);
    const double range = 4.0 - (truth * kSonar).translation().y();
    dut = Updated(dut, {{kSonar, range + rng.Normal(0.008), 0.008}}, {}).state;
  }
  // Without ranges: sqrt(100 * 3e-6) = 1 degree.
  EXPECT_LT(Degrees(std::sqrt(dut.covariance(2, 2))), 0.75);
  EXPECT_LT(std::abs(WrapAngle(dut.mean(2) - truth.yaw)), 4 * std::sqrt(dut.covariance(2, 2)));
}

TEST(WallUpdate, ARangeThatIsNotTheWallsChangesNothing) {
  const PoseState state = WithTwoWalls();
  const double wall_m = Expected(state, 0, kSonar);
  for (const double range : {wall_m - 0.5, wall_m + 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const CycleUpdate dut = Updated(state, {{kSonar, range, 0.01}}, {});
    EXPECT_TRUE(dut.heard.none()) << range;
    EXPECT_EQ(dut.state.mean, state.mean);
  }
  // A sensor that looks elsewhere does not hear it, whatever it measures.
  EXPECT_TRUE(Updated(state, {{{0.5, 0, 0}, wall_m, 0.01}}, {}).heard.none());
  EXPECT_TRUE(Updated(state, {{kSonar, wall_m, 0.01}}, {}).heard[0]);
}

TEST(WallUpdate, KnowsAWallAgain) {
  const PoseState state = WithTwoWalls();
  EXPECT_EQ(SameWall(state, Seen(kPi / 2 + 0.05, 2.1)), 0);
  EXPECT_EQ(SameWall(state, Seen(-kPi / 2, 1.45)), 1);
  EXPECT_EQ(SameWall(state, Seen(kPi / 2, 1.6)), std::nullopt);
  EXPECT_EQ(SameWall(state, Seen(0, 2.0)), std::nullopt);
}

RC_GTEST_PROP(WallUpdate, BothPartsOfTheCovarianceStaySymmetricAndPositive, ()) {
  PoseState dut = WithTwoWalls();
  for (int i = 0; i < 30; ++i) {
    const int wall = *rc::gen::inRange(0, 2);
    const Pose2 sonar{0.1, wall == 0 ? 0.39 : -0.39, wall == 0 ? kPi / 2 : -kPi / 2};
    const double sigma = *rc::gen::element(1e-4, 0.01, 1.0);
    dut = Updated(dut, wall, {sonar, Expected(dut, wall, sonar) + *rc::gen::inRange(-9, 10) / 300.0, sigma})
              .state;
    for (const PoseState::Matrix& part : {dut.repeated, PoseState::Matrix(dut.covariance - dut.repeated)}) {
      RC_ASSERT((part - part.transpose()).norm() < 1e-12);
      RC_ASSERT(part.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > -1e-12);
    }
  }
}

}  // namespace
}  // namespace priamos::robot
