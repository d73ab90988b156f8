#include "common/covariance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace priamos {

SigmaRho ToSigmaRho(const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d sigma = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const auto rho = [&](int i, int j) {
    const double product = sigma(i) * sigma(j);
    return product > 0 ? std::clamp(covariance(i, j) / product, -1.0, 1.0) : 0.0;
  };
  return {sigma(0), sigma(1), sigma(2), rho(0, 1), rho(0, 2), rho(1, 2)};
}

Eigen::Matrix3d ToCovariance(const SigmaRho& s) {
  Eigen::Matrix3d correlation;
  correlation << 1, s.rho_x_y, s.rho_x_yaw, s.rho_x_y, 1, s.rho_y_yaw, s.rho_x_yaw, s.rho_y_yaw, 1;
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(correlation, Eigen::EigenvaluesOnly).eigenvalues()(0);
  if (least < 0) {
    // correlation = I + R; scaling R by k moves the least eigenvalue to 1 + k (least - 1) = 0.
    const double k = 1 / (1 - least);
    correlation = Eigen::Matrix3d::Identity() * (1 - k) + correlation * k;
  }
  const Eigen::Vector3d sigma(s.sigma_x, s.sigma_y, s.sigma_yaw);
  return sigma.asDiagonal() * correlation * sigma.asDiagonal();
}

}  // namespace priamos
