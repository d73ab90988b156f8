#include <fmt/format.h>

#include "head/core/edge_stereo.hpp"
#include "test/bench/vision_bench.hpp"
#include "test/support/space_scene.hpp"

namespace priamos::bench {
namespace {

struct Count {
  int right = 0, wrong = 0;
  double seconds = 0;

  double WrongPercent() const { return 100.0 * wrong / std::max(1, right + wrong); }
  void Add(const test::SpaceScene& scene, const std::vector<head::StereoMatch>& matches) {
    for (const head::StereoMatch& m : matches) {
      const int edge = scene.truth[0][m.left];
      (edge >= 0 && edge == scene.truth[1][m.right.front()] ? right : wrong)++;
    }
  }
};

}  // namespace

void BenchStereo(const VisionOptions& options, Figures& figures) {
  fmt::print("edges of a simulated room in three images: 120, 10 % missing, 10 % broken, 40 of clutter\n");
  Count two, three;
  Rng rng(31);
  const int n = options.quick ? 10 : 100;
  for (int i = 0; i < n; ++i) {
    const test::SpaceScene scene({}, rng);
    const double start = CpuSeconds();
    two.Add(scene, head::MatchBinocular(scene.views[0], scene.views[1], {}));
    const double middle = CpuSeconds();
    three.Add(scene, head::MatchTrinocular(scene.views[0], scene.views[1], scene.views[2], {}));
    two.seconds += middle - start, three.seconds += CpuSeconds() - middle;
  }
  figures.Note("  binocular: wrong matches", two.WrongPercent(), "%");
  figures.Note("  binocular: right matches per scene", double(two.right) / n, "");
  figures.Note("  trinocular: wrong matches", three.WrongPercent(), "%");
  figures.Note("  trinocular: right matches per scene", double(three.right) / n, "");
  figures.AtMost("  wrong matches, trinocular over binocular", three.WrongPercent() / two.WrongPercent(), 0.1,
                 "");
  figures.Note("  binocular: time", 1000 * two.seconds / n, "ms");
  figures.Note("  trinocular: time", 1000 * three.seconds / n, "ms");
}

}  // namespace priamos::bench
