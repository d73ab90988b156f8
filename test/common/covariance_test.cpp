#include "common/covariance.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>

namespace priamos {
namespace {

double Real(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

RC_GTEST_PROP(Covariance, SurvivesTheRoundTrip, ()) {
  Eigen::Matrix3d root;
  for (double& v : root.reshaped()) v = Real(-1, 1);
  const Eigen::Matrix3d covariance = root * root.transpose() + 1e-6 * Eigen::Matrix3d::Identity();
  RC_ASSERT((ToCovariance(ToSigmaRho(covariance)) - covariance).norm() < 1e-9);
}

RC_GTEST_PROP(Covariance, IsPositiveSemidefiniteForAnyCorrelations, ()) {
  const SigmaRho s{Real(0, 2), Real(0, 2), Real(0, 0.5), Real(-1, 1), Real(-1, 1), Real(-1, 1)};
  const Eigen::Matrix3d covariance = ToCovariance(s);
  RC_ASSERT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(0) > -1e-9);
  RC_ASSERT(std::abs(covariance(0, 0) - s.sigma_x * s.sigma_x) < 1e-12);
}

TEST(Covariance, ZeroVarianceGivesZeroCorrelation) {
  const SigmaRho dut = ToSigmaRho(Eigen::Matrix3d::Zero());
  EXPECT_EQ(dut.sigma_x, 0);
  EXPECT_EQ(dut.rho_x_yaw, 0);
}

}  // namespace
}  // namespace priamos
