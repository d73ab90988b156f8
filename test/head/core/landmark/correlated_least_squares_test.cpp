#include "head/core/landmark/correlated_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "common/random.hpp"

namespace priamos::head {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(CorrelatedLeastSquaresTest, OfOneUnknownIsTheWeightedMean) {
  CorrelatedLeastSquares dut;
  ASSERT_TRUE(dut.SetCovariance(Eigen::Vector2d(1, 4).asDiagonal()));
  ASSERT_TRUE(dut.Solve(VectorXd::Ones(2), Eigen::Vector2d(10, 20)));
  EXPECT_NEAR(dut.step()[0], 12, 1e-12);  // weights 1 and 1/4
  EXPECT_NEAR(dut.StepCovariance()(0, 0), 0.8, 1e-12);
  EXPECT_NEAR(dut.ChiSquared(), 2 * 2 + 8 * 8 / 4.0, 1e-12);
}

TEST(CorrelatedLeastSquaresTest, CommonErrorsDoNotAverageOut) {
  const double common = 9, own = 4;
  const int n = 8;
  CorrelatedLeastSquares dut;
  ASSERT_TRUE(dut.SetCovariance(MatrixXd::Constant(n, n, common) + own * MatrixXd::Identity(n, n)));
  ASSERT_TRUE(dut.Solve(VectorXd::Ones(n), VectorXd::Constant(n, 5)));
  EXPECT_NEAR(dut.StepCovariance()(0, 0), common + own / n, 1e-12);
  EXPECT_NEAR(dut.ShareOf(VectorXd::Constant(n, own)), own / n / (common + own / n), 1e-12);
  EXPECT_NEAR(dut.ShareOf(VectorXd::Zero(n)), 0, 1e-12);
}

TEST(CorrelatedLeastSquaresTest, InformationAboutAnotherUnknownIsWhatTheStepLeavesOfIt) {
  CorrelatedLeastSquares dut;
  ASSERT_TRUE(dut.SetCovariance(Eigen::Vector3d(4, 4, 4).asDiagonal()));
  ASSERT_TRUE(dut.Solve(VectorXd::Ones(3), Eigen::Vector3d(1, 2, 3)));
  EXPECT_NEAR(dut.InformationAbout(VectorXd::Ones(3))(0, 0), 0, 1e-12)
      << "the same as the unknown of the step";
  EXPECT_NEAR(dut.InformationAbout(Eigen::Vector3d(-1, 0, 1))(0, 0), 2 / 4.0, 1e-12);
  EXPECT_NEAR(dut.InformationAbout(Eigen::Vector3d(0, 0, 1))(0, 0), (1 - 1 / 3.0) / 4.0, 1e-12);
}

TEST(CorrelatedLeastSquaresTest, AgreesWithTheNormalEquations) {
  Rng rng(1);
  for (int round = 0; round < 20; ++round) {
    const int n = 4 + round, d = 3;
    MatrixXd root(n, n), jacobian(n, d);
    VectorXd distance(n);
    for (double& v : root.reshaped()) v = rng.Normal(1);
    for (double& v : jacobian.reshaped()) v = rng.Normal(1);
    for (double& v : distance) v = rng.Normal(1);
    const MatrixXd covariance = root * root.transpose() + MatrixXd::Identity(n, n);
    CorrelatedLeastSquares dut;
    ASSERT_TRUE(dut.SetCovariance(covariance));
    ASSERT_TRUE(dut.Solve(jacobian, distance));
    const MatrixXd weight = covariance.inverse();
    const MatrixXd expected = (jacobian.transpose() * weight * jacobian).inverse();
    const VectorXd step = expected * jacobian.transpose() * weight * distance;
    const VectorXd left = distance - jacobian * step;
    EXPECT_LT((dut.StepCovariance() - expected).norm(), 1e-9 * expected.norm());
    EXPECT_LT((dut.step() - step).norm(), 1e-9 * (1 + step.norm()));
    EXPECT_NEAR(dut.ChiSquared(), left.dot(weight * left), 1e-9 * (1 + dut.ChiSquared()));
  }
}

TEST(CorrelatedLeastSquaresTest, IndependentErrorsHaveAllOfTheShare) {
  const Eigen::Vector4d variance(1, 2, 3, 4);
  const MatrixXd jacobian{{1, 0}, {1, 1}, {0, 1}, {2, -1}};
  CorrelatedLeastSquares dut;
  ASSERT_TRUE(dut.SetCovariance(variance.asDiagonal()));
  ASSERT_TRUE(dut.Solve(jacobian, Eigen::Vector4d(1, 0, 2, 1)));
  EXPECT_NEAR(dut.ShareOf(variance), 1, 1e-12);
}

TEST(CorrelatedLeastSquaresTest, RefusesWhatDoesNotDetermineTheUnknowns) {
  CorrelatedLeastSquares dut;
  ASSERT_TRUE(dut.SetCovariance(MatrixXd::Identity(3, 3)));
  EXPECT_FALSE(dut.Solve(MatrixXd::Ones(3, 2), VectorXd::Ones(3)));
}

TEST(CorrelatedLeastSquaresTest, RefusesWhatIsNoCovariance) {
  EXPECT_FALSE(CorrelatedLeastSquares().SetCovariance(Eigen::Vector2d(1, -1).asDiagonal()));
}

}  // namespace
}  // namespace priamos::head
