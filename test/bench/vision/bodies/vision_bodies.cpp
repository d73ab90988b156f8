#include <fmt/format.h>

#include "test/bench/vision/bodies/body_series.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr int kStartsPerScene = 5;

/// `n` scenes from `seed` on, each from several starts.
BodyTally Series(const BodySceneOptions& drawn, const BodyStart& start, int n, std::uint64_t seed,
                 bool verbose) {
  BodyTally tally;
  for (int i = 0; i < n; ++i) {
    Rng rng = Rng::Stream(seed + i, "start");
    AddStarts(DrawBody(drawn, seed + i), start, kStartsPerScene, rng, verbose, tally);
  }
  return tally;
}

}  // namespace

void BenchBodies(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 100;
  std::uint64_t seed = options.seed;
  for (const double blur_px : {0.0, 3.0}) {
    for (const BodyStart& start : {kNearStart, kFarStart}) {
      Series({.blur_px = blur_px}, start, n, seed, options.verbose)
          .Print(fmt::format("Bodies, blur {:.0f} px, {}", blur_px, start.Words()),
                 {start.success_percent, true}, figures);
      seed += n;
    }
  }
  for (const double error_m : {0.0005, 0.002})
    Series({.model_error_m = error_m}, kNearStart, n / 2, seed, options.verbose)
        .Print(fmt::format("Bodies whose model is off by {:.1f} mm", 1000 * error_m), {98, true}, figures);
  int found = 0;
  for (const double blur_px : {0.0, 3.0}) {
    for (const bool absent : {true, false}) {
      const BodySceneOptions drawn{.blur_px = blur_px, .is_absent = absent, .is_another = !absent};
      found += Series(drawn, kFarStart, n, seed, options.verbose).found();
      seed += n;
    }
  }
  figures.AtMost(fmt::format("Found of {} looks without the body, or at another one, sharp and blurred",
                             4 * n * kStartsPerScene),
                 found, 0, "");
}

}  // namespace priamos::bench
