#include "test/bench/vision/photometry/door_light.hpp"

#include <fmt/format.h>

#include "test/bench/vision/door_looks.hpp"
#include "test/bench/vision/fix_series.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/photometry/other_light.hpp"

namespace priamos::bench {

void BenchDoorLight(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 60;
  fmt::print("door of the map, {} looks, in a right image of another light\n", n);
  DoorPhotographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimen(1);
  std::vector<LandmarkLook> looks;
  looks.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) looks.push_back(photographer.Take(options.seed + i, Trouble::kNone, head));
  int good_of_equal = 0;
  for (const OtherLight& light : AllLights()) {
    int good = 0, wrong = 0;
    for (LandmarkLook look : looks) {
      look.images[light.of_first ? 0 : 1] = light.Of(look.images[light.of_first ? 0 : 1]);
      const head::LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
      if (fix.verdict != head::Verdict::kFound) continue;
      (IsGood(ErrorOf(fix.base_from_landmark, look.truth)) ? good : wrong)++;
    }
    if (good_of_equal == 0) good_of_equal = good;
    fmt::print("  {:38} right {:4} wrong {:4}\n", light.name, good, wrong);
    figures.AtLeast("  right, of those of equal cameras", double(good) / std::max(1, good_of_equal), 0.9, "");
  }
}

}  // namespace priamos::bench
