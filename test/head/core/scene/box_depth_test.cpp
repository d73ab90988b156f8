#include "head/core/scene/box_depth.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

const Pose2 kFront{2.6, -0.2, Radians(15)};

TEST(BoxDepth, TheSidesOfItsTopTellHowFarABoxReaches) {
  DrawnScene scene;
  scene.Level(kFront * Eigen::Vector2d(0, 0.35), kFront * Eigen::Vector2d(0.5, 0.35), 0.8);
  const auto depth = DepthBehind(scene.Views(), kFront, 0.7, 0.8, {});
  ASSERT_TRUE(depth);
  EXPECT_NEAR(*depth, 0.5, 0.01);
}

TEST(BoxDepth, EdgesAskewOrFromElsewhereAreNone) {
  DrawnScene scene;
  scene.Level(kFront * Eigen::Vector2d(0, 0.35), kFront * Eigen::Vector2d(0.4, 0.1), 0.8);
  scene.Level(kFront * Eigen::Vector2d(0, 0), kFront * Eigen::Vector2d(0.5, 0), 0.8);
  EXPECT_FALSE(DepthBehind(scene.Views(), kFront, 0.7, 0.8, {}));
}

TEST(BoxDepth, ATopThatIsNotSeenFromAboveTellsNothing) {
  DrawnScene scene;
  scene.Level(kFront * Eigen::Vector2d(0, 0.35), kFront * Eigen::Vector2d(0.5, 0.35), 1.4);
  EXPECT_FALSE(DepthBehind(scene.Views(), kFront, 0.7, 1.4, {}));
}

}  // namespace
}  // namespace priamos::head
