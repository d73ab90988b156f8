#include "head/core/landmark/left_out.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace priamos::head {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Ten measurements of two unknowns with correlated errors.
struct Measurements {
  MatrixXd covariance, jacobian;
  VectorXd distance;

  explicit Measurements(Rng& rng) : jacobian(10, 2), distance(10) {
    MatrixXd root(10, 10);
    for (double& v : root.reshaped()) v = rng.Normal(1);
    for (double& v : jacobian.reshaped()) v = rng.Normal(1);
    for (double& v : distance) v = rng.Normal(1);
    covariance = root * root.transpose() + MatrixXd::Identity(10, 10);
  }
  /// The solution from `rows` alone.
  CorrelatedLeastSquares Solved(const std::vector<int>& rows) const {
    CorrelatedLeastSquares solved;
    EXPECT_TRUE(solved.SetCovariance(covariance(rows, rows)));
    EXPECT_TRUE(solved.Solve(jacobian(rows, Eigen::all), distance(rows)));
    return solved;
  }
};

TEST(LeftOutTest, TellsWhatSolvingAnewWouldTell) {
  Rng rng(1);
  for (int round = 0; round < 20; ++round) {
    const Measurements all(rng);
    const CorrelatedLeastSquares solved = all.Solved({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    const auto dut = LeftOut(solved).Misfit({2, 5, 6});
    ASSERT_TRUE(dut);
    const double anew = all.Solved({0, 1, 3, 4, 7, 8, 9}).ChiSquared();
    EXPECT_NEAR(3 * *dut, solved.ChiSquared() - anew, 1e-9 * (1 + solved.ChiSquared()));
  }
}

TEST(LeftOutTest, RefusesWhatTheOthersNeed) {
  CorrelatedLeastSquares solved;
  ASSERT_TRUE(solved.SetCovariance(MatrixXd::Identity(3, 3)));
  ASSERT_TRUE(solved.Solve(MatrixXd{{1, 0}, {1, 0}, {0, 1}}, Eigen::Vector3d(1, 2, 3)));
  EXPECT_TRUE(LeftOut(solved).Misfit({0}));
  EXPECT_FALSE(LeftOut(solved).Misfit({2}));
}

}  // namespace
}  // namespace priamos::head
