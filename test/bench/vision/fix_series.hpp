#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "head/core/landmark/landmark_fix.hpp"
#include "test/bench/figures.hpp"
#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// How a series of fixes fared.
struct FixSeries {
  int looks = 0, good = 0, wrong = 0;
  std::map<std::string, int> refusals;
  std::vector<double> depth, lateral, yaw, nees, seconds, edge_seconds;

  void Add(const Eigen::Vector3d& error, double seconds_taken);
  /// Where a right fix is not what is wanted, but no wrong one; prints wrong ones.
  void Judge(const head::LandmarkFix& fix, const LandmarkLook& look, std::uint64_t seed);
  double MeanNees() const;
};

/// All of a fix that helps to understand it.
void Print(std::uint64_t seed, const head::LandmarkFix& fix, const Eigen::Vector3d& error);

/// Every figure that is promised of fixes.
void Report(const FixSeries& series, Figures& figures);

}  // namespace priamos::bench
