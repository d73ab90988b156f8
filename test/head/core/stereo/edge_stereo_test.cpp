#include "head/core/stereo/edge_stereo.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "test/support/space_scene.hpp"

namespace priamos::head {
namespace {

using test::SpaceScene;

SpaceScene::Options Clean(int n_edges) {
  SpaceScene::Options options;
  options.n_edges = n_edges;
  options.missing = 0;
  options.broken = 0;
  options.n_clutter = 0;
  return options;
}

/// The four error numbers of an edge (two points, across it) in units of their covariance.
double Nees(const SpaceEdge& found, const SpaceScene::Edge& truth) {
  const Eigen::Vector3d along = (truth.to - truth.from).normalized();
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = along.unitOrthogonal();
  across.col(1) = along.cross(across.col(0));
  Eigen::Matrix<double, 4, 6> project = Eigen::Matrix<double, 4, 6>::Zero();
  project.topLeftCorner<2, 3>() = across.transpose();
  project.bottomRightCorner<2, 3>() = across.transpose();
  Eigen::Matrix<double, 6, 1> ends;
  ends << found.from - truth.from, found.to - truth.from;
  const Eigen::Vector4d error = project * ends;
  const Eigen::Matrix4d covariance = project * found.covariance * project.transpose();
  return error.dot(covariance.inverse() * error) / 4;
}

TEST(ReconstructTest, ErrorsAreWhatTheCovarianceSays) {
  Rng rng(1);
  for (const int n_views : {2, 3}) {
    double sum = 0;
    int n = 0;
    for (int run = 0; run < 8; ++run) {
      const SpaceScene scene(Clean(60), rng);
      for (std::size_t i = 0; i < scene.truth[0].size(); ++i) {
        std::vector<LineSighting> sightings{{&scene.views[0], int(i)}};
        for (int v = 1; v < n_views; ++v) {
          const auto at = std::find(scene.truth[v].begin(), scene.truth[v].end(), scene.truth[0][i]);
          if (at != scene.truth[v].end())
            sightings.push_back({&scene.views[v], int(at - scene.truth[v].begin())});
        }
        if (int(sightings.size()) < n_views) continue;
        if (EpipolarAngle(scene.views[0].lines[i], Epipole(scene.cameras[0], scene.cameras[1])) < 0.15)
          continue;
        const auto edge = Reconstruct(sightings, 0);
        if (!edge) continue;
        sum += Nees(*edge, scene.edges[scene.truth[0][i]]);
        ++n;
      }
    }
    EXPECT_GT(n, 100);
    EXPECT_NEAR(sum / n, 1, 0.2) << n_views << " views";
  }
}

TEST(ReconstructTest, TheThirdImageMakesItMoreAccurate) {
  Rng rng(2);
  const SpaceScene scene(Clean(40), rng);
  int n = 0;
  for (std::size_t i = 0; i < scene.truth[0].size(); ++i) {
    std::vector<LineSighting> sightings{{&scene.views[0], int(i)}};
    for (int v = 1; v < 3; ++v) {
      const auto at = std::find(scene.truth[v].begin(), scene.truth[v].end(), scene.truth[0][i]);
      if (at != scene.truth[v].end())
        sightings.push_back({&scene.views[v], int(at - scene.truth[v].begin())});
    }
    if (sightings.size() < 3) continue;
    const auto two = Reconstruct(std::span(sightings).first(2), 0.1), three = Reconstruct(sightings, 0.1);
    if (!two || !three) continue;
    EXPECT_LE(three->covariance.trace(), 1.05 * two->covariance.trace());
    ++n;
  }
  EXPECT_GT(n, 10);
}

TEST(MatchBinocularTest, MatchesACleanScene) {
  Rng rng(3);
  const SpaceScene scene(Clean(15), rng);
  const auto dut = MatchBinocular(scene.views[0], scene.views[1], {});
  int right = 0;
  for (const StereoMatch& m : dut) right += scene.truth[0][m.left] == scene.truth[1][m.right.front()];
  EXPECT_GE(dut.size(), 8u);
  EXPECT_GE(right, int(dut.size()) - 1);
}

TEST(MatchBinocularTest, EdgesAlongTheEpipolarLineAreFlagged) {
  Rng rng(4);
  SpaceScene::Options options = Clean(12);
  options.only_horizontal = true;
  const SpaceScene scene(options, rng);
  const auto dut = MatchBinocular(scene.views[0], scene.views[1], {});
  EXPECT_GE(dut.size(), 5u);
  for (const StereoMatch& m : dut) {
    EXPECT_TRUE(m.is_near_epipolar);
    EXPECT_FALSE(m.space);
  }
}

TEST(MatchBinocularTest, PiecesOfABrokenLineShareTheirPartner) {
  Rng rng(5);
  SpaceScene::Options options = Clean(15);
  options.broken = 0.5;
  int several = 0;
  for (int run = 0; run < 5; ++run) {
    const SpaceScene scene(options, rng);
    std::vector<int> uses(scene.views[1].lines.size(), 0);
    for (const StereoMatch& m : MatchBinocular(scene.views[0], scene.views[1], {})) {
      several += m.right.size() > 1 && scene.truth[1][m.right[0]] == scene.truth[0][m.left] &&
                 scene.truth[1][m.right[1]] == scene.truth[0][m.left];
      ++uses[m.right.front()];
    }
    several += std::count_if(uses.begin(), uses.end(), [](int n) { return n > 1; });
  }
  EXPECT_GT(several, 5);
}

TEST(MatchTrinocularTest, ReconstructsEdgesAlongOnePairsEpipolarLines) {
  Rng rng(6);
  SpaceScene::Options options = Clean(12);
  options.only_horizontal = true;
  const SpaceScene scene(options, rng);
  const auto dut = MatchTrinocular(scene.views[0], scene.views[1], scene.views[2], {});
  EXPECT_GE(dut.size(), 5u);
  for (const StereoMatch& m : dut) {
    ASSERT_TRUE(m.space);
    EXPECT_EQ(scene.truth[0][m.left], scene.truth[1][m.right.front()]);
    EXPECT_LT(Nees(*m.space, scene.edges[scene.truth[0][m.left]]), 10);
  }
}

TEST(MatchTrinocularTest, MakesFarFewerWrongMatches) {
  Rng rng(7);
  int wrong[2] = {0, 0}, total[2] = {0, 0};
  for (int run = 0; run < 6; ++run) {
    const SpaceScene scene({}, rng);
    const std::vector<StereoMatch> found[2] = {
        MatchBinocular(scene.views[0], scene.views[1], {}),
        MatchTrinocular(scene.views[0], scene.views[1], scene.views[2], {})};
    for (int k = 0; k < 2; ++k) {
      for (const StereoMatch& m : found[k]) {
        const int edge = scene.truth[0][m.left];
        wrong[k] += edge < 0 || edge != scene.truth[1][m.right.front()];
        ++total[k];
      }
    }
  }
  EXPECT_GT(total[1], 150);
  EXPECT_LE(wrong[1] * total[0], 0.1 * wrong[0] * total[1])
      << wrong[0] << " of " << total[0] << ", " << wrong[1] << " of " << total[1];
}

TEST(MatchTrinocularTest, SwappedImagesGiveNothing) {
  Rng rng(8);
  const SpaceScene scene({}, rng);
  EdgeImage left = scene.images[1], right = scene.images[0];
  const CameraView swapped_left = MakeView(scene.cameras[0], left),
                   swapped_right = MakeView(scene.cameras[1], right);
  const auto proper = MatchTrinocular(scene.views[0], scene.views[1], scene.views[2], {});
  const auto dut = MatchTrinocular(swapped_left, swapped_right, scene.views[2], {});
  EXPECT_LT(dut.size(), proper.size() / 4);
}

}  // namespace
}  // namespace priamos::head
