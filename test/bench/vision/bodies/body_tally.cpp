#include "test/bench/vision/bodies/body_tally.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "common/geometry.hpp"

namespace priamos::bench {
namespace {

constexpr double kShift_percent = 1, kTurn_deg = 1;
constexpr double kHonest = 22.5;  ///< chi squared of six degrees of freedom that 99.9 % stay below

double Mean(const std::vector<double>& v) {
  return v.empty() ? 0 : std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

double Quantile(std::vector<double> v, double share) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
}

}  // namespace

void BodyTally::Add(const head::FreeModelFix& fix, const Eigen::Isometry3d& truth, double seconds) {
  ++n_;
  seconds_ += seconds;
  slowest_ = std::max(slowest_, seconds);
  if (fix.verdict != head::Verdict::kFound) return;
  ++found_;
  Eigen::Matrix<double, 6, 1> error;
  const Eigen::AngleAxisd turn((fix.base_from_model.linear() * truth.linear().transpose()).eval());
  error << fix.base_from_model.translation() - truth.translation(), turn.angle() * turn.axis();
  const double shift_percent = 100 * error.head<3>().norm() / truth.translation().norm(),
               turn_deg = Degrees(turn.angle());
  const double chi_squared = error.dot(fix.covariance.ldlt().solve(error));
  if (shift_percent > kShift_percent || turn_deg > kTurn_deg) {
    ++wrong_;
    silently_wrong_ += chi_squared > kHonest;
    return;
  }
  shift_percent_.push_back(shift_percent);
  turn_deg_.push_back(turn_deg);
  nees_.push_back(chi_squared / 6);
  const Eigen::Vector3d place = error.head<3>();
  nees_position_.push_back(place.dot(fix.covariance.topLeftCorner<3, 3>().ldlt().solve(place)) / 3);
}

void BodyTally::Print(std::string_view title, const BodyGoals& goals, Figures& figures) const {
  fmt::print("{}: {} starts\n", title, n_);
  const double n = std::max(1, n_);
  figures.AtLeast("  found within 1 % and 1 degree", 100 * (found_ - wrong_) / n, goals.success_percent, "%");
  figures.AtMost("  found beyond that", wrong_, 0, "");
  figures.Note("  of these beyond 99.9 % of what the covariance says", silently_wrong_, "");
  figures.Note("  position error, median", Quantile(shift_percent_, 0.5), "%");
  figures.Note("  position error, 95 %", Quantile(shift_percent_, 0.95), "%");
  figures.Note("  rotation error, median", Quantile(turn_deg_, 0.5), "deg");
  figures.Note("  rotation error, 95 %", Quantile(turn_deg_, 0.95), "deg");
  figures.Note("  squared error over covariance, position", Mean(nees_position_), "");
  figures.Note("  the same, median", Quantile(nees_position_, 0.5), "");
  if (goals.nees) {
    figures.AtLeast("  the same, all six", Mean(nees_), 0.8, "");
    figures.AtMost("  the same, all six", Mean(nees_), 1.2, "");
  } else {
    figures.Note("  the same, all six", Mean(nees_), "");
  }
  figures.AtMost("  time, mean", 1000 * seconds_ / n, 10, "ms");
  figures.Note("  time, slowest", 1000 * slowest_, "ms");
}

}  // namespace priamos::bench
