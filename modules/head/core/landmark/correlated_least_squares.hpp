#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace priamos::head {

/// Linear least squares for measurements with correlated errors (generalised least squares): the step x for
/// which `distance` - `jacobian` x is least as counted by the inverse of the covariance of the errors.
class CorrelatedLeastSquares {
 public:
  /// Covariance of the errors of all measurements. False if it is not positive definite.
  bool SetCovariance(const Eigen::MatrixXd& covariance);
  /// One row per measurement. False if the measurements do not determine the unknowns.
  bool Solve(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& distance);

  const Eigen::VectorXd& step() const { return step_; }
  /// Covariance of the step.
  Eigen::MatrixXd StepCovariance() const;
  /// What the step leaves of the measurements, times the inverse of the covariance of their errors: an error
  /// with the covariance c to the measurements is, as far as these tell, c times this.
  Eigen::VectorXd WeightedResiduals() const;
  /// What the step leaves of the sum of squares, in standard deviations.
  double ChiSquared() const;
  /// Information about unknowns that the jacobian does not hold, after the step: `by_unknowns` is the
  /// derivative by them, a row per measurement.
  Eigen::MatrixXd InformationAbout(const Eigen::MatrixXd& by_unknowns) const;
  /// Share of the step's covariance that comes from errors of variance `variance` which are independent of
  /// each other, as a mean over all directions, 0..1; one per measurement.
  double ShareOf(const Eigen::VectorXd& variance) const;

 private:
  friend class LeftOut;

  Eigen::LLT<Eigen::MatrixXd> whitening_;
  Eigen::LDLT<Eigen::MatrixXd> information_;
  Eigen::MatrixXd jacobian_, white_jacobian_;
  Eigen::VectorXd distance_, white_distance_, step_;
};

}  // namespace priamos::head
