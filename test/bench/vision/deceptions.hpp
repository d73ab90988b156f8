#pragma once

#include <fmt/format.h>

#include "test/bench/vision/fix_series.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {

/// Scenes made to deceive, some of each of `troubles`: the answer may be "not found", never a wrong pose.
template <class Photographer, class Troubles>
void Deceive(const char* what, const Troubles& troubles, const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 20 : 200;
  fmt::print("{} that deceive: {} scenes of each kind\n", what, n);
  Photographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimen(1);
  int wrong = 0;
  for (const auto trouble : troubles) {
    FixSeries series;
    for (int i = 0; i < n; ++i) {
      const std::uint64_t seed = options.seed + 100000 * static_cast<int>(trouble) + i;
      const LandmarkLook look = photographer.Take(seed, trouble, head);
      series.Judge(fixer.Find(look, Told(look), look.model, look.calibrated), look, seed);
    }
    fmt::print("  {}: {} right, {} wrong, {} refused\n", Describe(trouble), series.good, series.wrong,
               series.looks - series.good - series.wrong);
    for (const auto& [why, count] : series.refusals) fmt::print("    {}: {}\n", why, count);
    wrong += series.wrong;
  }
  figures.AtMost("  silent wrong fixes", wrong, 0, "");
}

}  // namespace priamos::bench
