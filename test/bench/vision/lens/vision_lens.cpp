#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>

#include "test/bench/vision/door_looks.hpp"
#include "test/bench/vision/fix_series.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr std::array kWalls{"plaster", "concrete", "wood"};

/// What looks from one distance showed.
struct LensSeries : FixSeries {
  double zoom_steps = 0, focus_steps = 0;
  int edges = 0;

  void Take(const LandmarkLook& look, const head::LandmarkFix& fix, std::uint64_t seed) {
    zoom_steps += look.setting.zoom_step[0];
    focus_steps += look.setting.focus_step[0];
    const int before = good;
    Judge(fix, look, seed);
    if (good == before) return;
    const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
    edges += fix.n_matched;
    depth.push_back(std::abs(error.x()));
    lateral.push_back(std::abs(error.y()));
    yaw.push_back(std::abs(error.z()));
    nees.push_back(error.dot(fix.covariance.inverse() * error) / 3);
  }
};

void Tell(const char* what, const LensSeries& s) {
  fmt::print(
      "  {:7} {:2} of {:2} right, {} wrong; zoom {:4.0f}, focus {:4.0f}; {:4.1f} edges; median {:.2f} mm "
      "depth, {:.2f} mm lateral, {:.3f} deg; squared error over covariance {:.2f}\n",
      what, s.good, s.looks, s.wrong, s.zoom_steps / s.looks, s.focus_steps / s.looks,
      double(s.edges) / std::max(s.good, 1), 1e3 * Quantile(s.depth, 0.5), 1e3 * Quantile(s.lateral, 0.5),
      Degrees(Quantile(s.yaw, 0.5)), s.MeanNees());
}

}  // namespace

void BenchLens(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 60;
  fmt::print(
      "the door from near and far: one setting for all looks, and one chosen for each; {} looks each\n", n);
  DoorPhotographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimenWholly(1);
  int wrong = 0, fixed = 0, chosen = 0;
  for (const double doubt : {1.0, 0.1}) {
    for (const double distance_m : {1.2, 1.7, 2.4, 3.4, 4.4, 5.4}) {
      std::array<LensSeries, 2> series;
      for (int i = 0; i < n; ++i) {
        const std::uint64_t seed = options.seed + i;
        for (const bool choose : {false, true}) {
          const LandmarkLook look =
              photographer.Take(seed, {distance_m, doubt, choose, kWalls[seed % kWalls.size()]}, head);
          series[choose].Take(look, fixer.Find(look, Told(look), look.model, look.calibrated), seed);
        }
      }
      fmt::print(" {:.1f} m, believed up to {:.0f} cm and {:.1f} degrees beside it\n", distance_m, 20 * doubt,
                 5 * doubt);
      Tell("fixed", series[0]);
      Tell("chosen", series[1]);
      wrong += series[1].wrong;
      fixed += series[0].good;
      chosen += series[1].good;
    }
  }
  figures.Note("  right ones, one setting", fixed, "");
  figures.AtLeast("  right ones, chosen", chosen, fixed, "");
  figures.AtMost("  silent wrong fixes, chosen", wrong, 0, "");
}

}  // namespace priamos::bench
