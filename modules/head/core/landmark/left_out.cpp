#include "head/core/landmark/left_out.hpp"

namespace priamos::head {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Leaving some of the measurements out takes r' (P_ss)^-1 r from chi squared, where P is the projector and
/// r = P * distances.
LeftOut::LeftOut(const CorrelatedLeastSquares& solved) {
  const Eigen::Index n = solved.distance_.size();
  const MatrixXd identity = MatrixXd::Identity(n, n);
  projector_ = solved.whitening_.solve(identity);
  const MatrixXd to_unknowns = projector_ * solved.jacobian_;
  const MatrixXd across = to_unknowns.transpose();
  const MatrixXd explained = solved.information_.solve(across);
  projector_.noalias() -= to_unknowns * explained;
  rest_ = projector_ * solved.distance_;
}

std::optional<double> LeftOut::Misfit(const std::vector<int>& rows) const {
  const MatrixXd block = projector_(rows, rows);
  const Eigen::LDLT<MatrixXd> ldlt(block);
  if (ldlt.rcond() < 1e-9) return std::nullopt;
  const VectorXd own = rest_(rows);
  const VectorXd solved = ldlt.solve(own);
  return own.dot(solved) / static_cast<double>(rows.size());
}

}  // namespace priamos::head
