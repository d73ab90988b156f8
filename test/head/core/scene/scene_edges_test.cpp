#include "head/core/scene/scene_edges.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

TEST(SceneEdges, AreThoseThatHaveAPlaceInSpace) {
  test::DrawnScene scene;
  scene.Upright({3, 0.4}, 0.6, 1.6);
  scene.Level({3, 0.3}, {3, -0.5}, 1);  // along the line between both cameras
  const StereoViews views = scene.Views();
  const auto edges = SceneEdges(views[0], scene.Matches(views));
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR((edges[0].middle - Eigen::Vector3d(3, 0.4, 1.1)).norm(), 0, 0.01);
  EXPECT_GT(edges[0].covariance(0, 0), edges[0].covariance(1, 1)) << "it is known worst along the sight";
  EXPECT_NEAR(edges[0].length_px, views[0].lines[0].length_px, 1e-9);
}

}  // namespace
}  // namespace priamos::head
