#include <fmt/format.h>

#include <Eigen/Dense>

#include "test/bench/vision/cupboard_looks.hpp"
#include "test/bench/vision/deceptions.hpp"

namespace priamos::bench {
namespace {

using head::LandmarkFix, head::Verdict;

/// Whole looks at a cupboard, each with another specimen of the head, calibrated by itself.
void Looks(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 120;
  fmt::print("cupboard from +-20 cm and +-5 degrees at 2 m, {} looks, each with its own head\n", n);
  CupboardPhotographer photographer;
  Fixer fixer;
  FixSeries series;
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    const LandmarkLook look = photographer.Take(seed, CupboardTrouble::kNone, CalibrateSpecimen(seed));
    const LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
    const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
    ++series.looks;
    if (options.verbose) Print(seed, fix, error);
    if (fix.verdict != Verdict::kFound) {
      ++series.refusals[head::Describe(fix.verdict)];
      continue;
    }
    series.Add(error, fixer.seconds);
    series.edge_seconds.push_back(fixer.edge_seconds);
    series.nees.push_back(error.dot(fix.covariance.inverse() * error) / 3);
  }
  Report(series, figures);
}

}  // namespace

void BenchCupboard(const VisionOptions& options, Figures& figures) {
  Looks(options, figures);
  Deceive<CupboardPhotographer>("cupboards", kCupboardTroubles, options, figures);
}

}  // namespace priamos::bench
