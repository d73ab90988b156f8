#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
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

/// What estimate and measurement may have in common.
template <int kRows>
struct Common {
  PoseState::Matrix repeated;                         ///< part of the estimate's repeated covariance
  Eigen::Matrix<double, kRows, kRows> measurement{};  ///< without what tells next to nothing
};

/// A measurement can repeat only errors that go with the directions that it tells something of. One that
/// tells a heading alone repeats errors of headings, and of places as far as they go with those; to widen all
/// the rest for it would throw away what is known of the place. In the other directions it does not count at
/// all, lest many that tell next to nothing do.
template <int kRows>
Common<kRows> CommonOf(const PoseState& prior, const Eigen::Matrix<double, kRows, kRows>& measurement,
                       const Derivative<kRows>& h) {
  using Rows = Eigen::Matrix<double, kRows, kRows>;
  constexpr double kTells = 0.04;  // variance of the state over that of the measurement: sigmas as 1 to 5
  constexpr double kSilent = 1e6;
  const Eigen::LLT<Rows> root(measurement);
  if (root.info() != Eigen::Success) return {prior.repeated, measurement};
  const Derivative<kRows> whitened = root.matrixL().solve(h);
  const Eigen::SelfAdjointEigenSolver<Rows> ratios(whitened * prior.covariance * whitened.transpose());
  const Derivative<kRows> along = ratios.eigenvectors().transpose() * whitened;
  Common<kRows> common{PoseState::Matrix::Zero(prior.size(), prior.size())};
  PoseState::Matrix left = prior.repeated;
  Eigen::Matrix<double, kRows, 1> widened;
  for (int i = 0; i < kRows; ++i) {
    const bool tells = ratios.eigenvalues()(i) > kTells;
    widened(i) = tells ? 1 : kSilent;
    const PoseState::Vector with = left * along.row(i).transpose();
    const double variance = along.row(i).dot(with);
    if (!tells || !(variance > 0)) continue;
    const PoseState::Matrix part = with * with.transpose() / variance;
    common.repeated += part;
    left -= part;
  }
  const Rows axes = root.matrixL() * ratios.eigenvectors();
  common.measurement = axes * widened.asDiagonal() * axes.transpose();
  return common;
}

/// Fusion with a fixed `weight` of the estimate, in (0, 1); the measurement has the rest. `own_share`: of the
/// measurement's covariance, independent of all others.
template <int kRows>
SplitFusion<kRows> Weighed(const PoseState& prior, const Common<kRows>& common, double own_share,
                           double weight) {
  return {prior.covariance + (1 / weight - 1) * common.repeated,
          (own_share + (1 - own_share) / (1 - weight)) * common.measurement};
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
  const Common<kRows> common = CommonOf<kRows>(prior, measurement, h);
  const auto spread = [&](double weight) {
    const auto fusion = Weighed<kRows>(prior, common, own_share, weight);
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
  return Weighed<kRows>(prior, common, own_share, (low + high) / 2);
}

}  // namespace priamos::robot
