#pragma once

#include <Eigen/Core>

#include "robot/core/pose/pose_state.hpp"

namespace priamos::robot {

/// Gain of a Kalman update by `kRows` numbers, and their derivative by the state.
template <int kRows>
using Gain = Eigen::Matrix<double, Eigen::Dynamic, kRows, 0, PoseState::kMost, kRows>;
template <int kRows>
using Derivative = Eigen::Matrix<double, kRows, Eigen::Dynamic,
                                 kRows == 1 ? Eigen::RowMajor : Eigen::ColMajor, kRows, PoseState::kMost>;

/// The covariance after an update; this form (Bucy and Joseph, "Filtering for Stochastic Processes", 1968)
/// stays symmetric and positive whatever was rounded.
template <int kRows>
PoseState::Matrix Joseph(const Gain<kRows>& gain, const Derivative<kRows>& h, const PoseState::Matrix& prior,
                         const Eigen::Matrix<double, kRows, kRows>& measurement) {
  const PoseState::Matrix keep = PoseState::Matrix::Identity(prior.rows(), prior.cols()) - gain * h;
  return keep * prior * keep.transpose() + gain * measurement * gain.transpose();
}

}  // namespace priamos::robot
