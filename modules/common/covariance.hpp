#pragma once

#include <Eigen/Core>

namespace priamos {

/// A 3x3 covariance of (x, y, yaw) as messages carry it: standard deviations and correlations.
struct SigmaRho {
  double sigma_x = 0, sigma_y = 0, sigma_yaw = 0;
  double rho_x_y = 0, rho_x_yaw = 0, rho_y_yaw = 0;
};

/// Zero variances give zero correlations.
SigmaRho ToSigmaRho(const Eigen::Matrix3d& covariance);

/// Symmetric, and positive semidefinite even when the correlations were rounded on a radio: they are scaled
/// towards 0 as far as necessary.
Eigen::Matrix3d ToCovariance(const SigmaRho& sigma_rho);

/// The covariance of a message that carries it in fields of these names, as pose_t does.
template <class Message>
Eigen::Matrix3d CovarianceIn(const Message& m) {
  return ToCovariance({m.sigma_x_m, m.sigma_y_m, m.sigma_yaw_rad, m.rho_x_y, m.rho_x_yaw, m.rho_y_yaw});
}

}  // namespace priamos
