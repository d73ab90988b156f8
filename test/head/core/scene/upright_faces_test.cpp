#include "head/core/scene/upright_faces.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

std::vector<UprightFace> FacesOf(const DrawnScene& scene) {
  const StereoViews views = scene.Views();
  return FindFaces(views, SceneEdges(views[0], scene.Matches(views)), scene.Uprights(views), {});
}

TEST(UprightFaces, ARectangleIsOneFace) {
  DrawnScene scene;
  scene.Face({3, 0.4}, {3.2, -0.3}, 0.5, 1.4);
  const auto faces = FacesOf(scene);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_NEAR(faces[0].width_m, 0.728, 0.01);
  EXPECT_NEAR(faces[0].bottom_m, 0.5, 0.02);
  EXPECT_NEAR(faces[0].top_m, 1.4, 0.02);
}

TEST(UprightFaces, LeftIsOnTheLeftHandOfTheHead) {
  DrawnScene scene;
  scene.Face({3, -0.3}, {3, 0.4}, 0.5, 1.4);
  const StereoViews views = scene.Views();
  const auto uprights = scene.Uprights(views);
  const auto faces = FindFaces(views, SceneEdges(views[0], scene.Matches(views)), uprights, {});
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_GT(uprights[faces[0].left].at.y(), uprights[faces[0].right].at.y());
}

TEST(UprightFaces, UprightEdgesThatNothingJoinsAreNoFace) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.5, 1.4);
  scene.Upright({3, -0.3}, 0.5, 1.4);
  EXPECT_TRUE(FacesOf(scene).empty());
}

TEST(UprightFaces, ALevelEdgeThatEndsElsewhereJoinsNothing) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.5, 1.4);
  scene.Upright({3, -0.3}, 0.5, 1.4);
  scene.Level({3, 0.4}, {3, -0.3}, 0.95);
  EXPECT_TRUE(FacesOf(scene).empty());
}

TEST(UprightFaces, AHalfSeenLowerPartIsNotMissed) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.2, 1.4);  // the picture ends at 0.34 m
  scene.Upright({3, -0.3}, 0.2, 1.4);
  scene.Level({3, 0.4}, {3, -0.3}, 1.4);
  const auto faces = FacesOf(scene);
  ASSERT_EQ(faces.size(), 1u);
}

TEST(UprightFaces, ALevelEdgeThatLeadsElsewhereIsNoTop) {
  DrawnScene scene;
  scene.Upright({3, 0.4}, 0.5, 1.4);
  scene.Upright({3, -0.3}, 0.5, 1.1);  // its upper part was not seen
  scene.Level({3, 0.4}, {3, -1.1}, 1.4);
  EXPECT_TRUE(FacesOf(scene).empty());
  DrawnScene ends_there;
  ends_there.Upright({3, 0.4}, 0.5, 1.4);
  ends_there.Upright({3, -0.3}, 0.5, 1.1);
  ends_there.Level({3, 0.4}, {3, -0.3}, 1.4);
  EXPECT_EQ(FacesOf(ends_there).size(), 1u);
}

TEST(UprightFaces, AnOpeningThroughWhichTheRoomIsSeenIsNone) {
  DrawnScene scene;
  scene.Face({3, 0.4}, {3, -0.4}, 0.5, 1.6);
  scene.Upright({5, 0.1}, 0.8, 1.4);
  scene.Upright({5, -0.2}, 0.8, 1.4);
  EXPECT_TRUE(FacesOf(scene).empty());
}

TEST(UprightFaces, WhatIsLevelBehindADoorwayDoesNotCloseIt) {
  DrawnScene scene;
  for (const double y : {0.4, -0.4}) {  // jambs in two pieces
    scene.Upright({3, y}, 0.5, 1.0);
    scene.Upright({3, y}, 1.04, 1.9);
  }
  scene.Level({3, 0.4}, {3, -0.4}, 1.0);  // a skirting far behind looks like this
  EXPECT_TRUE(FacesOf(scene).empty());
}

TEST(UprightFaces, APictureOnAFaceIsPartOfIt) {
  DrawnScene scene;
  scene.Face({3, 0.5}, {3, -0.5}, 0.5, 1.6);
  scene.Face({3, 0.2}, {3, -0.2}, 0.8, 1.2);
  EXPECT_EQ(FacesOf(scene).size(), 1u);
}

}  // namespace
}  // namespace priamos::head
