#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace priamos::planner {

/// The normal equations: information * step = right.
struct GraphEquations {
  explicit GraphEquations(int size) : right(Eigen::VectorXd::Zero(size)) {}

  /// Adds a residual and its derivatives by some unknowns; what has a negative index is held.
  template <int kRows, int kCols>
  void Add(const Eigen::Matrix<double, kRows, 1>& error, const Eigen::Matrix<double, kRows, kCols>& by,
           const std::array<int, kCols>& at, double weight) {
    const Eigen::Matrix<double, kCols, kCols> information = weight * by.transpose() * by;
    const Eigen::Matrix<double, kCols, 1> gradient = weight * by.transpose() * error;
    for (int i = 0; i < kCols; ++i) {
      if (at[std::size_t(i)] < 0) continue;
      right(at[std::size_t(i)]) -= gradient(i);
      for (int k = 0; k < kCols; ++k)
        if (at[std::size_t(k)] >= 0)
          entries.emplace_back(at[std::size_t(i)], at[std::size_t(k)], information(i, k));
    }
  }

  Eigen::SparseMatrix<double> Information(double damping) const {
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    auto all = entries;
    for (int i = 0; i < right.size(); ++i) all.emplace_back(i, i, damping);
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
  }

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right;
};

}  // namespace priamos::planner
