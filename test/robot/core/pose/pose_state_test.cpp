#include "robot/core/pose/pose_state.hpp"

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
  return {
      .from = FromUtime(0), .to = FromUtime(0) + time, .twist = {0.4, -0.2, 0.6}, .wander = {.kept = 0.8}};
}

TEST(PoseState, ConstantErrorsScaleAndTurnTheMeasuredMotion) {
  PoseState state;
  state.mean << 0, 0, 0, 0.1, 0.2, 0.3, 0.05, 0.02, 0, 0, 0;
  const Twist2 twist = Unbiased(state, {1, 0.5, 0.2});
  EXPECT_NEAR(twist.vx, 1.1, 1e-12);
  EXPECT_NEAR(twist.vy, 0.6 + 0.02, 1e-12);
  EXPECT_NEAR(twist.wz, 0.26 + 0.05, 1e-12);
}

TEST(PoseState, SlipThatWandersIsForgottenWithTheDistance) {
  PoseState state;
  state.mean << 0, 0, 0, 0, 0, 0, 0, 0, 0.02, 0.01, -0.01;
  const Twist2 twist = Unbiased(state, {1, 0.5, 0.2});
  EXPECT_NEAR(twist.vx, 1.02, 1e-12);
  EXPECT_NEAR(twist.wz, 0.21, 1e-12);
  EXPECT_NEAR(twist.vy, 0.49, 1e-12);
  OdometryStep step = SomeStep();
  step.wander.variance << 1e-6, 2e-6, 3e-6;
  const PoseState next = Propagated(state, step);
  EXPECT_TRUE(next.mean.tail<3>().isApprox(0.8 * state.mean.tail<3>()));
  EXPECT_TRUE(next.covariance.diagonal().tail<3>().isApprox(step.wander.variance));
}

TEST(PoseState, CovarianceIsCarriedByTheDerivativeOfTheMotion) {
  const PoseState state = SomeState();
  const PoseState next = Propagated(state, SomeStep());
  constexpr double kStep = 1e-6;
  PoseState::Matrix f(PoseState::kOwn, PoseState::kOwn);
  for (int i = 0; i < PoseState::kOwn; ++i) {
    PoseState moved = state;
    moved.mean(i) += kStep;
    f.col(i) = (Propagated(moved, SomeStep()).mean - next.mean) / kStep;
  }
  const PoseState::Matrix expected = f * state.covariance * f.transpose();
  EXPECT_LT((next.covariance - expected).norm() / expected.norm(), 2e-3);
}

TEST(PoseState, NoiseOfTheStepIsTurnedIntoTheMap) {
  PoseState state;
  state.mean(2) = kPi / 2;
  OdometryStep step = SomeStep(milliseconds(20));
  step.twist = {};
  step.noise(0, 0) = 0.01;
  const PoseState next = Propagated(state, step);
  EXPECT_NEAR(next.covariance(1, 1), 0.01, 1e-12);
  EXPECT_NEAR(next.covariance(0, 0), 0, 1e-12);
}

}  // namespace
}  // namespace priamos::robot
