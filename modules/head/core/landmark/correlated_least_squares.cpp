#include "head/core/landmark/correlated_least_squares.hpp"

namespace priamos::head {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool CorrelatedLeastSquares::SetCovariance(const MatrixXd& covariance) {
  whitening_.compute(covariance);
  return whitening_.info() == Eigen::Success;
}

bool CorrelatedLeastSquares::Solve(const MatrixXd& jacobian, const VectorXd& distance) {
  jacobian_ = white_jacobian_ = jacobian;
  distance_ = white_distance_ = distance;
  whitening_.matrixL().solveInPlace(white_jacobian_);
  whitening_.matrixL().solveInPlace(white_distance_);
  const MatrixXd information = white_jacobian_.transpose() * white_jacobian_;
  information_.compute(information);
  // A pivot of exactly zero is left out by Eigen's inverse, and by its condition number.
  const bool regular = information_.info() == Eigen::Success && information_.vectorD().minCoeff() > 0;
  if (!regular || information_.rcond() < 1e-12) return false;
  const VectorXd right = white_jacobian_.transpose() * white_distance_;
  step_ = information_.solve(right);
  return true;
}

MatrixXd CorrelatedLeastSquares::StepCovariance() const {
  const MatrixXd identity = MatrixXd::Identity(step_.size(), step_.size());
  return information_.solve(identity);
}

VectorXd CorrelatedLeastSquares::WeightedResiduals() const {
  const VectorXd left = distance_ - jacobian_ * step_;
  return whitening_.solve(left);
}

double CorrelatedLeastSquares::ChiSquared() const {
  const VectorXd left = white_distance_ - white_jacobian_ * step_;
  return left.squaredNorm();
}

MatrixXd CorrelatedLeastSquares::InformationAbout(const MatrixXd& by_unknowns) const {
  const MatrixXd white = whitening_.matrixL().solve(by_unknowns);
  const MatrixXd shared = white_jacobian_.transpose() * white;
  return white.transpose() * white - shared.transpose() * information_.solve(shared);
}

/// The step is P J' V^-1 times the errors of the distances. So a part C of their covariance V makes
/// P (A' C A) P of P, where A = V^-1 J: as a share of it trace(A' C A P) / d, and all parts together 1.
double CorrelatedLeastSquares::ShareOf(const VectorXd& variance) const {
  const MatrixXd a = whitening_.matrixU().solve(white_jacobian_);
  const MatrixXd across = a.transpose();
  const MatrixXd weighted = information_.solve(across);
  double share = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    share += variance[i] * a.row(i).dot(weighted.col(i)) / static_cast<double>(a.cols());
  return share;
}

}  // namespace priamos::head
