#include "head/core/scene/level_borders.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

std::vector<LevelBorder> BordersOf(const DrawnScene& scene) {
  const StereoViews views = scene.Views();
  const CameraView third = scene.Third();
  return FindLevelBorders(views, third, scene.MatchesOfAll(views, third), {});
}

/// The longest border across, as a base meets it, and its distance.
double FrontOf(const std::vector<LevelBorder>& borders) {
  double nearest = 100;
  for (const LevelBorder& border : borders)
    if (std::abs(border.direction().x()) < 0.1) nearest = std::min(nearest, border.from.x());
  return nearest;
}

TEST(LevelBorders, ABorderThatIsAskewIsKnownByStereo) {
  DrawnScene scene;
  scene.Level({2.2, 0.3}, {2.6, -0.3}, 0.72);
  const auto borders = BordersOf(scene);
  ASSERT_EQ(borders.size(), 1u);
  EXPECT_NEAR(borders[0].height_m, 0.72, 0.005);
  EXPECT_NEAR(borders[0].length_m(), 0.72, 0.02);
  EXPECT_TRUE(borders[0].from_ends && borders[0].to_ends);
}

TEST(LevelBorders, OneAlongTheBaselineIsKnownByTheThirdCamera) {
  DrawnScene scene;
  scene.Level({3, 0.4}, {3, -0.4}, 0.8);
  EXPECT_NEAR(FrontOf(BordersOf(scene)), 3, 0.03);
}

TEST(LevelBorders, OrByTheBorderAtWhichItEnds) {
  DrawnScene scene;
  scene.Level({3, 0.4}, {3, -0.4}, 0.8);
  scene.Level({3, 0.4}, {3.6, 0.4}, 0.8);
  const StereoViews views = scene.Views();
  const CameraView third = scene.Third();
  EXPECT_NEAR(FrontOf(FindLevelBorders(views, third, scene.Matches(views), {})), 3, 0.02);
}

TEST(LevelBorders, WhatIsBelowTheSonarsAboveTheRobotOrNotLevelIsNone) {
  DrawnScene scene;
  scene.Level({2.6, 0.4}, {3.0, -0.2}, 0.3);
  scene.Level({3.5, 0.3}, {3.9, -0.3}, 1.5);
  scene.Edge({2.4, 0.5, 0.6}, {2.6, 0.2, 0.8});
  scene.Upright({3, -0.4}, 0.6, 1.1);
  EXPECT_TRUE(BordersOf(scene).empty());
}

TEST(LevelBorders, WhatTheThirdCameraDoesNotShowIsNone) {
  DrawnScene scene;
  scene.Level({2.2, 0.3}, {2.6, -0.3}, 0.72);
  const StereoViews views = scene.Views();
  CameraView third = scene.Third();
  third.lines.clear();
  EXPECT_TRUE(FindLevelBorders(views, third, scene.Matches(views), {}).empty());
}

}  // namespace
}  // namespace priamos::head
