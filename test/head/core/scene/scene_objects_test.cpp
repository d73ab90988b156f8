#include "head/core/scene/scene_objects.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

std::vector<SceneObject> ObjectsOf(const DrawnScene& scene) {
  const StereoViews views = scene.Views();
  return ReconstructScene(views, scene.Matches(views), {}).objects;
}

TEST(SceneObjects, ABoxHasAFrontAndADepth) {
  DrawnScene scene;
  const Pose2 front{2.6, -0.3, Radians(25)};
  scene.Box(front, 0.7, 0.5, 1.3);
  const auto objects = ObjectsOf(scene);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].kind, ObjectKind::kBox);
  EXPECT_NEAR(objects[0].base_from_front.x, front.x, 0.01);
  EXPECT_NEAR(objects[0].base_from_front.y, front.y, 0.01);
  EXPECT_NEAR(objects[0].base_from_front.yaw, front.yaw, 0.02);
  EXPECT_NEAR(objects[0].width_m, 0.7, 0.01);
  EXPECT_NEAR(objects[0].depth_m, 0.5, 0.02);
  EXPECT_NEAR(objects[0].top_m, 1.3, 0.02);
}

TEST(SceneObjects, ABoxWhoseSidesAreHiddenHasTheDepthOfItsTop) {
  DrawnScene scene;
  const Eigen::Vector2d left(2.6, 0.3), right(2.6, -0.3);
  scene.Face(left, right, 0, 0.9);
  scene.Level(left, {3, 0.3}, 0.9);
  const auto objects = ObjectsOf(scene);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].kind, ObjectKind::kBox);
  EXPECT_NEAR(objects[0].depth_m, 0.4, 0.02);
}

TEST(SceneObjects, ACornerOfTheRoomIsNoBox) {
  DrawnScene scene;
  const Eigen::Vector2d corner(4, 0);
  scene.Face({3.4, 0.6}, corner, 0.5, 1.6);
  scene.Upright({3.4, -0.6}, 0.5, 1.6);
  scene.Level(corner, {3.4, -0.6}, 0.5);
  scene.Level(corner, {3.4, -0.6}, 1.6);
  const auto objects = ObjectsOf(scene);
  EXPECT_EQ(objects.size(), 2u);
  for (const SceneObject& object : objects) EXPECT_EQ(object.kind, ObjectKind::kFace);
}

TEST(SceneObjects, AnUprightEdgeThatNothingJoinsRemainsOne) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.6, 1.6);
  scene.Upright({3, -0.4}, 0.6, 0.8);  // too short to be told
  const auto objects = ObjectsOf(scene);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].kind, ObjectKind::kEdge);
  EXPECT_EQ(objects[0].width_m, 0);
  EXPECT_NEAR(objects[0].base_from_front.y, 0.4, 0.01);
}

TEST(SceneObjects, NothingIsNothing) {
  EXPECT_TRUE(ObjectsOf(DrawnScene()).empty());
}

}  // namespace
}  // namespace priamos::head
