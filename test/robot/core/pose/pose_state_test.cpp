#include "robot/core/pose/pose_state.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using Vector = PoseState::Vector;

PoseState SomeState() {
  PoseState state;
  state.mean << 1, 2, 0.7, 0.01, -0.02, 0.01, 0.004, -0.003;
  Vector sigma(8);
  sigma << 0.1, 0.12, 0.05, 0.01, 0.02, 0.01, 0.004, 0.003;
  state.covariance = sigma.cwiseAbs2().asDiagonal();
  return state;
}

OdometryStep SomeStep(Duration time = milliseconds(200)) {
  return {.from = FromUtime(0), .to = FromUtime(0) + time, .twist = {0.4, -0.2, 0.6}};
}

TEST(PoseState, ConstantErrorsScaleAndTurnTheMeasuredMotion) {
  PoseState state;
  state.mean << 0, 0, 0, 0.1, 0.2, 0.3, 0.05, 0.02;
  const Twist2 twist = Unbiased(state, {1, 0.5, 0.2});
  EXPECT_NEAR(twist.vx, 1.1, 1e-12);
  EXPECT_NEAR(twist.vy, 0.6 + 0.02, 1e-12);
  EXPECT_NEAR(twist.wz, 0.26 + 0.05, 1e-12);
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
