#include "head/core/scene/level_ends.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

const Eigen::Vector2d kRight(3, -0.3), kLeft(3.2, 0.4);

/// A face of which stereo knows the right arris alone.
std::vector<UprightEdge> Known() {
  return {{kRight, 1e-4 * Eigen::Matrix2d::Identity(), 0.5, 1.6}};
}

TEST(LevelEnds, ALevelEdgeLeadsToTheOtherUprightEdge) {
  DrawnScene scene;
  scene.Face(kLeft, kRight, 0.5, 1.6);
  auto uprights = Known();
  AddUprightsAtLevelEnds(scene.Views(), {}, {}, uprights);
  ASSERT_EQ(uprights.size(), 2u);
  EXPECT_NEAR((uprights[1].at - kLeft).norm(), 0, 0.02);
  EXPECT_NEAR(uprights[1].top_m, 1.6, 0.01);
  EXPECT_GT(uprights[1].covariance(0, 0), uprights[0].covariance(0, 0));
}

TEST(LevelEnds, WhereNoUprightEdgeIsSeenThereIsNone) {
  DrawnScene scene;
  scene.Upright(kRight, 0.5, 1.6);
  scene.Level(kLeft, kRight, 1.6);
  auto uprights = Known();
  AddUprightsAtLevelEnds(scene.Views(), {}, {}, uprights);
  EXPECT_EQ(uprights.size(), 1u);
}

TEST(LevelEnds, AtTheHeightOfTheEyeALevelEdgeTellsNoDistance) {
  DrawnScene scene;
  scene.Face(kLeft, kRight, 0.5, 1.22);
  std::vector<UprightEdge> uprights = {{kRight, 1e-4 * Eigen::Matrix2d::Identity(), 0.5, 1.22}};
  AddUprightsAtLevelEnds(scene.Views(), {}, {}, uprights);
  EXPECT_EQ(uprights.size(), 1u);
}

TEST(LevelEnds, WhatStereoFoundIsNotFoundAgain) {
  DrawnScene scene;
  scene.Face(kLeft, kRight, 0.5, 1.6);
  const StereoViews views = scene.Views();
  auto uprights = scene.Uprights(views);
  ASSERT_EQ(uprights.size(), 2u);
  AddUprightsAtLevelEnds(views, {}, {}, uprights);
  EXPECT_EQ(uprights.size(), 2u);
}

}  // namespace
}  // namespace priamos::head
