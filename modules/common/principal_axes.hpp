#pragma once

#include <Eigen/Core>

namespace priamos {

/// Eigenvalues of a symmetric matrix, ascending, and its orthonormal eigenvectors, one per column. Of a
/// covariance: the variances along the principal axes of its ellipsoid, and these axes.
template <int N>
struct PrincipalAxes {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> axes;
};

/// For N = 2, 3 and 6, each compiled once: an eigenvalue solver takes seconds.
template <int N>
PrincipalAxes<N> PrincipalAxesOf(const Eigen::Matrix<double, N, N>& symmetric);

/// Standard deviation [m] of a position in the direction where it is known worst; `covariance` of (x, y, yaw)
/// [m, rad].
double PositionSigma(const Eigen::Matrix3d& covariance);

}  // namespace priamos
