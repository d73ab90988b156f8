#include <fmt/format.h>

#include <Eigen/Dense>

#include "test/bench/cupboard_looks.hpp"
#include "test/bench/fix_series.hpp"
#include "test/bench/landmark_fixes.hpp"
#include "test/bench/vision_bench.hpp"

namespace priamos::bench {
namespace {

using head::LandmarkFix, head::Verdict;

void Print(std::uint64_t seed, const LandmarkFix& fix, const Eigen::Vector3d& error) {
  fmt::print(
      "  seed {}: {}, {:.2f} {:.2f} mm {:.3f} deg, misfit {:.2f}, {} edges, log odds {:.1f}, rival {:.1f}\n",
      seed, head::Describe(fix.verdict), 1000 * error.x(), 1000 * error.y(), Degrees(error.z()), fix.misfit,
      fix.n_matched, fix.log_odds, fix.rival_log_odds);
}

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

/// The answer may be "not found", never a wrong pose.
void Deceptions(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 20 : 200;
  fmt::print("cupboards that deceive: {} of each kind\n", n);
  CupboardPhotographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimen(1);
  int wrong = 0;
  for (const CupboardTrouble trouble : kCupboardTroubles) {
    FixSeries series;
    for (int i = 0; i < n; ++i) {
      const std::uint64_t seed = options.seed + 100000 * static_cast<int>(trouble) + i;
      const LandmarkLook look = photographer.Take(seed, trouble, head);
      const LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
      if (fix.verdict != Verdict::kFound) {
        ++series.refusals[head::Describe(fix.verdict)];
        continue;
      }
      const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
      const bool right = look.is_there && IsGood(error);
      (right ? series.good : series.wrong)++;
      if (!right) Print(seed, fix, error);
    }
    fmt::print("  {}: {} right, {} wrong\n", Describe(trouble), series.good, series.wrong);
    for (const auto& [why, count] : series.refusals) fmt::print("    {}: {}\n", why, count);
    wrong += series.wrong;
  }
  figures.AtMost("  silent wrong fixes", wrong, 0, "");
}

}  // namespace

void BenchCupboard(const VisionOptions& options, Figures& figures) {
  Looks(options, figures);
  Deceptions(options, figures);
}

}  // namespace priamos::bench
