#include "head/core/scene/table_tops.hpp"

#include <gtest/gtest.h>

#include "head/core/scene/scene_objects.hpp"
#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

const Eigen::Vector3d kEye(0.25, 0.1, 1.2);

LevelBorder Border(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height_m = 0.7) {
  return {from, to, height_m, 0.002, true, true};
}

std::vector<SceneObject> Grouped(const std::vector<LevelBorder>& borders,
                                 const std::vector<SceneObject>& standing = {}) {
  return GroupBorders(borders, standing, kEye, {});
}

TEST(TableTops, TwoBordersOfACornerAreATop) {
  const auto tops = Grouped({Border({2, 0.5}, {2, -0.5}), Border({2, 0.5}, {2.6, 0.5})});
  ASSERT_EQ(tops.size(), 1u);
  EXPECT_EQ(tops[0].kind, ObjectKind::kBox);
  EXPECT_NEAR(tops[0].base_from_front.x, 2, 1e-9);
  EXPECT_NEAR(tops[0].base_from_front.y, 0, 1e-9);
  EXPECT_NEAR(tops[0].base_from_front.yaw, 0, 1e-9);
  EXPECT_NEAR(tops[0].width_m, 1, 1e-9);
  EXPECT_NEAR(tops[0].depth_m, 0.6, 1e-9);
  EXPECT_NEAR(tops[0].top_m, 0.7, 1e-9);
  EXPECT_GT(tops[0].bottom_m, 0.6) << "it hangs";
}

TEST(TableTops, LinesOnItMakeItNoOtherAndNoSecondOne) {
  const auto tops = Grouped({Border({2, 0.5}, {2, -0.5}), Border({2, 0.5}, {2.6, 0.5}),
                             Border({2.2, 0.3}, {2.25, -0.4}), Border({2.5, 0.2}, {2.5, -0.2})});
  ASSERT_EQ(tops.size(), 1u);
  EXPECT_NEAR(tops[0].depth_m, 0.6, 1e-9);
}

TEST(TableTops, TheLowerArrisBelongsToItAndAShelfFarBelowDoesNot) {
  EXPECT_EQ(Grouped({Border({2, 0.5}, {2, -0.5}), Border({2, 0.5}, {2, -0.5}, 0.66)}).size(), 1u);
  EXPECT_EQ(Grouped({Border({2, 0.5}, {2, -0.5}, 1), Border({2, 0.5}, {2, -0.5}, 0.5)}).size(), 2u);
}

TEST(TableTops, ABorderAloneIsALowFace) {
  const auto tops = Grouped({Border({2, 0.5}, {2, -0.5})});
  ASSERT_EQ(tops.size(), 1u);
  EXPECT_EQ(tops[0].kind, ObjectKind::kFace);
  EXPECT_EQ(tops[0].depth_m, 0);
  EXPECT_NEAR(tops[0].base_from_front.yaw, 0, 1e-9) << "away from the head";
}

TEST(TableTops, TwoTablesAreTwo) {
  EXPECT_EQ(Grouped({Border({2, 1}, {2, 0.3}), Border({2, -0.3}, {2, -1})}).size(), 2u);
}

TEST(TableTops, TheTopOfAThingThatStandsIsThatThing) {
  SceneObject carton;
  carton.kind = ObjectKind::kBox;
  carton.base_from_front = {2, 0, 0};
  carton.width_m = 1;
  carton.depth_m = 0.6;
  carton.top_m = 0.7;
  EXPECT_TRUE(Grouped({Border({2, 0.5}, {2, -0.5}), Border({2, 0.5}, {2.6, 0.5})}, {carton}).empty());
}

TEST(TableTops, ATableIsFoundInThreePictures) {
  test::DrawnScene scene;
  const Pose2 front{2.1, 0.05, Radians(15)};
  scene.Top(front, 0.8, 0.6, 0.72);
  const StereoViews views = scene.Views();
  const CameraView third = scene.Third();
  const auto objects = ReconstructScene(views, scene.MatchesOfAll(views, third), {}, &third).objects;
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].kind, ObjectKind::kBox);
  EXPECT_NEAR(objects[0].base_from_front.x, front.x, 0.02);
  EXPECT_NEAR(objects[0].base_from_front.y, front.y, 0.02);
  EXPECT_NEAR(objects[0].base_from_front.yaw, front.yaw, 0.03);
  EXPECT_NEAR(objects[0].width_m, 0.8, 0.03);
  EXPECT_NEAR(objects[0].depth_m, 0.6, 0.03);
  EXPECT_TRUE(ReconstructScene(views, scene.Matches(views), {}).objects.empty())
      << "without the third camera";
}

}  // namespace
}  // namespace priamos::head
