#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "head/core/landmark/correlated_least_squares.hpp"

namespace priamos::head {

/// How much better the other measurements would fit without some of them: exact, and without solving anew.
class LeftOut {
 public:
  /// After a Solve that succeeded.
  explicit LeftOut(const CorrelatedLeastSquares& solved);

  /// Part of chi squared per measurement that goes when the measurements `rows` are left out; nullopt when
  /// the others would not determine the unknowns.
  std::optional<double> Misfit(const std::vector<int>& rows) const;

 private:
  Eigen::MatrixXd projector_;  ///< projects out what the unknowns explain
  Eigen::VectorXd rest_;
};

}  // namespace priamos::head
