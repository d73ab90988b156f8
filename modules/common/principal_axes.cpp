#include "common/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <type_traits>

namespace priamos {

template <int N>
PrincipalAxes<N> PrincipalAxesOf(const Eigen::Matrix<double, N, N>& symmetric) {
  // Eigen has shorter code for 3 by 3. All other sizes share the code for any size, with the same results.
  using Solved = std::conditional_t<N == 3, Eigen::Matrix3d, Eigen::MatrixXd>;
  const Eigen::SelfAdjointEigenSolver<Solved> solver{Solved(symmetric)};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template PrincipalAxes<2> PrincipalAxesOf(const Eigen::Matrix2d&);
template PrincipalAxes<3> PrincipalAxesOf(const Eigen::Matrix3d&);
template PrincipalAxes<6> PrincipalAxesOf(const Eigen::Matrix<double, 6, 6>&);

double PositionSigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, PrincipalAxesOf<2>(covariance.topLeftCorner<2, 2>()).values(1)));
}

}  // namespace priamos
