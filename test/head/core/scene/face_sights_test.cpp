#include "head/core/scene/face_sights.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

const FacePlane kFace({3, 0.4}, {3, -0.4}, 0.5, 1.6);

bool IsOpen(const DrawnScene& scene) {
  const StereoViews views = scene.Views();
  return IsSeenThrough(kFace, *views[0].camera, SceneEdges(views[0], scene.Matches(views)), 0.06);
}

TEST(FaceSights, WhatIsSeenBehindItOpensIt) {
  DrawnScene scene;
  scene.Upright({4, 0.1}, 0.7, 1.5);
  EXPECT_TRUE(IsOpen(scene));
}

TEST(FaceSights, WhatIsOnItBeforeItOrBesideItDoesNot) {
  DrawnScene scene;
  EXPECT_FALSE(IsOpen(scene));
  scene.Upright({3, 0.1}, 0.7, 1.5);
  scene.Upright({2.5, -0.1}, 0.9, 1.3);
  scene.Upright({4, 1.0}, 0.7, 1.5);
  EXPECT_FALSE(IsOpen(scene));
}

TEST(FaceSights, OneShortEdgeMayBeAnOutlier) {
  DrawnScene scene;
  scene.Upright({4, 0.1}, 1.0, 1.1);
  EXPECT_FALSE(IsOpen(scene));
}

}  // namespace
}  // namespace priamos::head
