#include <fmt/format.h>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/stereo/edge_stereo.hpp"
#include "test/bench/vision/stereo_scenes.hpp"
#include "test/bench/vision/vision_bench.hpp"
#include "test/support/space_scene.hpp"

namespace priamos::bench {
namespace {

struct Count {
  int right = 0, wrong = 0, scenes = 0;
  double seconds = 0;

  double WrongPercent() const { return 100.0 * wrong / std::max(1, right + wrong); }
  void Add(bool is_right) { (is_right ? right : wrong)++; }
};

/// Matches that give an edge of space, with two cameras and with three, and the ratio of the wrong ones.
void Report(const Count& two, const Count& three, Figures& figures) {
  for (const auto& [name, count] : {std::pair{"binocular", &two}, std::pair{"trinocular", &three}}) {
    figures.Note(fmt::format("  {}: wrong matches", name), count->WrongPercent(), "%");
    figures.Note(fmt::format("  {}: right matches per scene", name), double(count->right) / count->scenes,
                 "");
    figures.Note(fmt::format("  {}: time", name), 1000 * count->seconds / count->scenes, "ms");
  }
  figures.AtMost("  wrong matches, trinocular over binocular",
                 three.WrongPercent() / std::max(1e-9, two.WrongPercent()), 0.1, "");
}

void SimulatedEdges(const VisionOptions& options, Figures& figures) {
  fmt::print("edges of a simulated room in three images: 120, 10 % missing, 10 % broken, 40 of clutter\n");
  Count two, three;
  Rng rng(31);
  const int n = options.quick ? 10 : 100;
  for (int i = 0; i < n; ++i) {
    const test::SpaceScene scene({}, rng);
    const auto add = [&](const std::vector<head::StereoMatch>& matches, Count& count) {
      ++count.scenes;
      for (const head::StereoMatch& m : matches) {
        const int edge = scene.truth[0][m.left];
        if (m.space) count.Add(edge >= 0 && edge == scene.truth[1][m.right.front()]);
      }
    };
    const double start = CpuSeconds();
    const auto pairs = head::MatchBinocular(scene.views[0], scene.views[1], {});
    const double middle = CpuSeconds();
    const auto triples = head::MatchTrinocular(scene.views[0], scene.views[1], scene.views[2], {});
    two.seconds += middle - start;
    three.seconds += CpuSeconds() - middle;
    add(pairs, two);
    add(triples, three);
  }
  Report(two, three, figures);
}

/// What a mistake looks like: the image line, how far beside it the match lies, and what spoke for it.
void PrintWrong(std::uint64_t seed, const StereoTriple& triple, const std::array<head::CameraView, 3>& views,
                const head::StereoMatch& match) {
  const head::ViewLine& line = views[0].lines[match.left];
  fmt::print(
      "  seed {}: ({:.0f} {:.0f}) to ({:.0f} {:.0f}), beside the truth by {:.1f} px, similarity {:.2f}, "
      "chi squared {:.1f}, {:.1f} m away\n",
      seed, line.p.x(), line.p.y(), line.q.x(), line.q.y(),
      triple.Beside(views[0], match.left, views[1], match.right.front()), match.similarity, match.space->chi2,
      match.space->from.x());
}

void RenderedEdges(StereoScene scene, const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 5 : 50;
  fmt::print("rendered: {}, {} views\n", Describe(scene), n);
  StereoStage stage;
  head::EdgeOperator edge_operator;
  Count two, three;
  for (int i = 0; i < n; ++i) {
    const StereoTriple triple = stage.Take(scene, options.seed + i);
    std::array<head::EdgeImage, 3> edges;
    std::array<head::CameraView, 3> views;
    for (int c = 0; c < 3; ++c) {
      edge_operator.Extract(triple.images[c], edges[c]);
      views[c] = head::MakeView(triple.cameras[c], edges[c]);
    }
    const auto add = [&](const std::vector<head::StereoMatch>& matches, Count& count) {
      ++count.scenes;
      for (const head::StereoMatch& m : matches) {
        if (!m.space) continue;
        const bool is_right = triple.IsSameEdge(views[0], m.left, views[1], m.right.front());
        count.Add(is_right);
        if (!is_right && options.verbose && &count == &three) PrintWrong(options.seed + i, triple, views, m);
      }
    };
    const double start = CpuSeconds();
    const auto pairs = head::MatchBinocular(views[0], views[1], {});
    const double middle = CpuSeconds();
    const auto triples = head::MatchTrinocular(views[0], views[1], views[2], {});
    two.seconds += middle - start;
    three.seconds += CpuSeconds() - middle;
    add(pairs, two);
    add(triples, three);
  }
  Report(two, three, figures);
}

}  // namespace

void BenchStereo(const VisionOptions& options, Figures& figures) {
  SimulatedEdges(options, figures);
  for (const StereoScene scene : kStereoScenes) RenderedEdges(scene, options, figures);
}

}  // namespace priamos::bench
