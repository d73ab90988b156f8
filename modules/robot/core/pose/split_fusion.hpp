#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "robot/core/pose/joseph.hpp"

namespace priamos::robot {

/// Estimate and measurement with their repeated parts widened so far that they count as independent: split
/// covariance intersection (Julier and Uhlmann, "General decentralized data fusion with covariance
/// intersection", Handbook of Multisensor Data Fusion, 2001).
template <int kRows>
struct SplitFusion {
  PoseState::Matrix prior;
  Eigen::Matrix<double, kRows, kRows> measurement;

  Gain<kRows> GainFor(const Derivative<kRows>& h) const {
    const Eigen::Matrix<double, kRows, kRows> spread = h * prior * h.transpose() + measurement;
    return spread.ldlt().solve(h * prior).transpose();
  }
};

/// Fusion with a fixed `weight` of the estimate, in (0, 1); the measurement has the rest. `own_share`: of its
/// covariance, independent of all others.
template <int kRows>
SplitFusion<kRows> Weighed(const PoseState& prior, const Eigen::Matrix<double, kRows, kRows>& measurement,
                           double own_share, double weight) {
  return {prior.covariance + (1 / weight - 1) * prior.repeated,
          (own_share + (1 - own_share) / (1 - weight)) * measurement};
}

/// The weight after which the state is known best (golden section over the determinant, whose logarithm is
/// convex): of all of it, lest what the measurement does not show be widened for nothing.
template <int kRows>
SplitFusion<kRows> BestFusion(const PoseState& prior, const Eigen::Matrix<double, kRows, kRows>& measurement,
                              double own_share, const Derivative<kRows>& h) {
  using Matrix = PoseState::Matrix;
  constexpr double kLeast = 1e-4, kGolden = 0.618, kExact = 1e-12;
  constexpr int kSteps = 20;
  if (prior.repeated.isZero(0) || own_share >= 1) return {prior.covariance, measurement};
  const auto spread = [&](double weight) {
    const auto fusion = Weighed<kRows>(prior, measurement, own_share, weight);
    const Matrix after = Joseph<kRows>(fusion.GainFor(h), h, fusion.prior, fusion.measurement);
    return (after + kExact * Matrix::Identity(after.rows(), after.cols())).determinant();
  };
  double low = kLeast, high = 1 - kLeast;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = spread(a), at_b = spread(b);
  for (int i = 0; i < kSteps; ++i) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = spread(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = spread(b);
    }
  }
  return Weighed<kRows>(prior, measurement, own_share, (low + high) / 2);
}

}  // namespace priamos::robot
