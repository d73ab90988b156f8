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

}  // namespace
}  // namespace priamos::head
