#include "test/bench/vision/fix_series.hpp"

#include <fmt/format.h>

#include <cmath>

#include "test/bench/vision/landmark_fixes.hpp"

namespace priamos::bench {

void FixSeries::Add(const Eigen::Vector3d& error, double seconds_taken) {
  const bool is_good = IsGood(error);
  (is_good ? good : wrong)++;
  if (!is_good) return;
  depth.push_back(1000 * std::abs(error.x()));
  lateral.push_back(1000 * std::abs(error.y()));
  yaw.push_back(Degrees(std::abs(error.z())));
  seconds.push_back(seconds_taken);
}

void FixSeries::Judge(const head::LandmarkFix& fix, const LandmarkLook& look, std::uint64_t seed) {
  ++looks;
  if (fix.verdict != head::Verdict::kFound) {
    ++refusals[head::Describe(fix.verdict)];
    return;
  }
  const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
  const bool is_right = look.is_there && IsGood(error);
  (is_right ? good : wrong)++;
  if (!is_right) Print(seed, fix, error);
}

double FixSeries::MeanNees() const {
  double sum = 0;
  for (const double n : nees) sum += n;
  return nees.empty() ? 0 : sum / nees.size();
}

void Print(std::uint64_t seed, const head::LandmarkFix& fix, const Eigen::Vector3d& error) {
  fmt::print(
      "  seed {}: {}, {:.2f} {:.2f} mm {:.3f} deg, misfit {:.2f}, {} edges, log odds {:.1f} of {:.1f}, rival "
      "{:.1f}, "
      "side {:.2f}\n",
      seed, head::Describe(fix.verdict), 1000 * error.x(), 1000 * error.y(), Degrees(error.z()), fix.misfit,
      fix.n_matched, fix.log_odds, fix.best_log_odds, fix.rival_log_odds, fix.side_share);
}

void Report(const FixSeries& s, Figures& figures) {
  for (const auto& [why, n] : s.refusals) fmt::print("  refused, {}: {}\n", why, n);
  figures.AtLeast("  within 3 cm and 1 degree, of 60", 60.0 * s.good / s.looks, 59, "");
  figures.AtMost("  silent wrong fixes", s.wrong, 0, "");
  figures.AtMost("  lateral error, median", Quantile(s.lateral, 0.5), 2, "mm");
  figures.AtMost("  lateral error, 95 %", Quantile(s.lateral, 0.95), 6, "mm");
  figures.AtMost("  depth error, median", Quantile(s.depth, 0.5), 2, "mm");
  figures.AtMost("  depth error, 95 %", Quantile(s.depth, 0.95), 6, "mm");
  figures.AtMost("  heading error, median", Quantile(s.yaw, 0.5), 0.05, "deg");
  figures.AtMost("  heading error, 95 %", Quantile(s.yaw, 0.95), 0.15, "deg");
  figures.AtLeast("  squared error over covariance, per degree of freedom", s.MeanNees(), 0.8, "");
  figures.AtMost("  squared error over covariance, per degree of freedom", s.MeanNees(), 1.2, "");
  figures.AtMost("  time per stereo pair, edges included", 1000 * Quantile(s.seconds, 0.5), 8, "ms");
  figures.Note("    of it the edge operator", 1000 * Quantile(s.edge_seconds, 0.5), "ms");
}

}  // namespace priamos::bench
