#include <fmt/format.h>

#include <Eigen/Dense>

#include "test/bench/vision/deceptions.hpp"
#include "test/bench/vision/door_looks.hpp"
#ifdef PRIAMOS_HAS_VISP
#include "test/bench/vision/visp_door.hpp"
#endif

namespace priamos::bench {
namespace {

using head::LandmarkFix, head::Verdict;

/// Whole looks at the door, each with another specimen of the head, calibrated by itself.
void Looks(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 120;
  fmt::print("door from +-20 cm and +-5 degrees at 2.4 m, {} looks, each with its own head and calibration\n",
             n);
  DoorPhotographer photographer;
  Fixer fixer;
  FixSeries series;
#ifdef PRIAMOS_HAS_VISP
  FixSeries stereo, mono;
#endif
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    const LandmarkLook look = photographer.Take(seed, Trouble::kNone, CalibrateSpecimen(seed));
    ++series.looks;
    const LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
    if (fix.verdict != Verdict::kFound) {
      ++series.refusals[head::Describe(fix.verdict)];
      if (options.verbose) fmt::print("  seed {}: {}\n", seed, head::Describe(fix.verdict));
    } else {
      const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
      series.Add(error, fixer.seconds);
      series.edge_seconds.push_back(fixer.edge_seconds);
      series.nees.push_back(error.dot(fix.covariance.inverse() * error) / 3);
      if (options.verbose) {
        const Eigen::Vector3d s = fix.covariance.diagonal().cwiseSqrt();
        fmt::print(
            "  seed {}: {:.2f} {:.2f} mm {:.3f} deg, sigma {:.2f} {:.2f} {:.3f}, nees {:.2f}, misfit {:.2f}, "
            "{} edges, {:.1f} ms\n",
            seed, 1000 * error.x(), 1000 * error.y(), Degrees(error.z()), 1000 * s.x(), 1000 * s.y(),
            Degrees(s.z()), series.nees.back(), fix.misfit, fix.n_matched, 1000 * fixer.seconds);
      }
    }
#ifdef PRIAMOS_HAS_VISP
    for (const bool both : {true, false}) {
      FixSeries& rival = both ? stereo : mono;
      ++rival.looks;
      const VispFix fix = FixWithVisp(look, both);
      if (fix.ok) rival.Add(ErrorOf(fix.base_from_landmark, look.truth), fix.seconds);
      if (!fix.ok) ++rival.refusals["lost"];
    }
#endif
  }
  Report(series, figures);
#ifdef PRIAMOS_HAS_VISP
  for (const auto& [name, rival] : {std::pair{"stereo", &stereo}, std::pair{"left image only", &mono}})
    fmt::print(
        "  ViSP edge tracker, {}: {} of {} good, {} silently wrong, median {:.1f} mm lateral, {:.1f} mm "
        "depth, "
        "{:.2f} degrees, {:.1f} ms\n",
        name, rival->good, rival->looks, rival->wrong, Quantile(rival->lateral, 0.5),
        Quantile(rival->depth, 0.5), Quantile(rival->yaw, 0.5), 1000 * Quantile(rival->seconds, 0.5));
#endif
}

/// What knowing the leaf's angle is worth, and what believing a wrong one costs.
void Leaves(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 20 : 200;
  fmt::print("leaf at any angle from closed to 90 degrees: {} scenes\n", n);
  constexpr const char* kNames[] = {"unknown", "told within half a degree", "told wrong by 10 to 60 degrees"};
  DoorPhotographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimen(1);
  FixSeries series[3];
  std::vector<double> odds[3];
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    const LandmarkLook look = photographer.Take(seed, Trouble::kLeafMoved, head);
    Rng rng = Rng::Stream(seed, "leaf");
    const double about = std::max(0.0, look.leaf_open_deg + rng.Uniform(-0.5, 0.5));
    const double wrong = std::fmod(look.leaf_open_deg + rng.Uniform(10, 60), 100);
    for (int k = 0; k < 3; ++k) {
      const auto model = k == 0 ? look.exact_model : ModelWithLeaf(k == 1 ? about : wrong);
      const LandmarkFix fix = fixer.Find(look, Told(look), model, look.calibrated);
      ++series[k].looks;
      if (fix.verdict != Verdict::kFound) {
        ++series[k].refusals[head::Describe(fix.verdict)];
        continue;
      }
      odds[k].push_back(fix.log_odds);
      series[k].Add(ErrorOf(fix.base_from_landmark, look.truth), fixer.seconds);
    }
  }
  for (int k = 0; k < 3; ++k) {
    fmt::print(
        "  leaf {}: {} right, median {:.2f} mm lateral, {:.2f} mm depth, {:.3f} degrees; log odds {:.0f}\n",
        kNames[k], series[k].good, Quantile(series[k].lateral, 0.5), Quantile(series[k].depth, 0.5),
        Quantile(series[k].yaw, 0.5), Quantile(odds[k], 0.5));
    for (const auto& [why, count] : series[k].refusals) fmt::print("    {}: {}\n", why, count);
    figures.AtMost("    silent wrong fixes", series[k].wrong, 0, "");
  }
}

}  // namespace

void BenchLeaves(const VisionOptions& options, Figures& figures) {
  Leaves(options, figures);
}

void BenchDoor(const VisionOptions& options, Figures& figures) {
  Looks(options, figures);
}

void BenchDeceptions(const VisionOptions& options, Figures& figures) {
  Deceive<DoorPhotographer>("doors", kTroubles, options, figures);
}

}  // namespace priamos::bench
