#include "head/core/scene/upright_edges.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

TEST(UprightEdges, AnUprightEdgeIsFoundWhereItStands) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.6, 1.6);
  const auto edges = scene.Uprights(scene.Views());
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].at.x(), 3, 0.002);
  EXPECT_NEAR(edges[0].at.y(), 0.4, 0.002);
  EXPECT_NEAR(edges[0].bottom_m, 0.6, 0.01);
  EXPECT_NEAR(edges[0].top_m, 1.6, 0.01);
  EXPECT_GT(edges[0].covariance(0, 0), edges[0].covariance(1, 1)) << "it is known worst along the sight";
}

TEST(UprightEdges, LevelAndLeaningEdgesAreNone) {
  DrawnScene scene;
  scene.Level({3, 0.4}, {3.4, -0.2}, 1);
  scene.Edge({3, 0.2, 0.6}, {3, 0.4, 1.6});
  EXPECT_TRUE(scene.Uprights(scene.Views()).empty());
}

TEST(UprightEdges, PiecesAboveEachOtherAreOneEdge) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.6, 1.0);
  scene.Upright({3, 0.4}, 1.1, 1.6);
  const auto edges = scene.Uprights(scene.Views());
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].bottom_m, 0.6, 0.01);
  EXPECT_NEAR(edges[0].top_m, 1.6, 0.01);
}

TEST(UprightEdges, ThoseBesideEachOtherAreTwo) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.6, 1.6);
  scene.Upright({3, 0.5}, 0.6, 1.6);
  EXPECT_EQ(scene.Uprights(scene.Views()).size(), 2u);
}

TEST(UprightEdges, WhatIsTooFarToBePlacedIsLeftOut) {
  DrawnScene scene;
  scene.Upright({6.5, 0.4}, 0.6, 1.6);
  EXPECT_TRUE(scene.Uprights(scene.Views()).empty());
}

TEST(UprightEdges, OneSightingTwiceIsNoSurerThanOnce) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.2, 1.6);
  const StereoViews views = scene.Views();
  auto matches = scene.Matches(views);
  ASSERT_EQ(matches.size(), 1u);
  const auto once = FindUprights(matches, {});
  matches.push_back(matches[0]);
  const auto twice = FindUprights(matches, {});
  ASSERT_EQ(once.size(), 1u);
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_NEAR(twice[0].covariance.trace(), once[0].covariance.trace(), 1e-12);
  EXPECT_NEAR((twice[0].at - once[0].at).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace priamos::head
