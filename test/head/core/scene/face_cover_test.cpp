#include "head/core/scene/face_cover.hpp"

#include <gtest/gtest.h>

#include "test/head/core/scene/drawn_scene.hpp"

namespace priamos::head {
namespace {

using test::DrawnScene;

const Eigen::Vector3d kFrom(3, 0.5, 1), kTo(3, -0.5, 1);

TEST(FaceCover, TheWorseSeenImageCounts) {
  DrawnScene scene;
  scene.Level({3, 0.5}, {3, 0}, 1);
  EXPECT_NEAR(CoverInBoth(scene.Views(), kFrom, kTo), 0.5, 0.02);
  StereoViews views = scene.Views();
  views[1].lines.clear();
  EXPECT_EQ(CoverInBoth(views, kFrom, kTo), 0);
}

TEST(FaceCover, OnlyThePartInThePictureCounts) {
  DrawnScene scene;
  scene.Level({3, 3}, {3, 0}, 1);
  EXPECT_NEAR(CoverInBoth(scene.Views(), {3, 3, 1}, {3, 0, 1}), 1, 0.02);
  EXPECT_EQ(CoverInBoth(scene.Views(), {3, 5, 1}, {3, 4, 1}), 0) << "it is beside the picture";
}

TEST(FaceCover, LinesReachTheEndStopThereOrRunOn) {
  const auto ends = [](double to_y, EndRule rule) {
    DrawnScene scene;
    scene.Level({3, 0.5}, {3, to_y}, 1);
    return EndsInBoth(scene.Views(), kFrom, kTo, rule, {8, 0});
  };
  EXPECT_TRUE(ends(-0.5, EndRule::kStop));
  EXPECT_TRUE(ends(-0.5, EndRule::kReach));
  EXPECT_FALSE(ends(-0.7, EndRule::kStop));
  EXPECT_TRUE(ends(-0.7, EndRule::kReach));
  EXPECT_FALSE(ends(-0.4, EndRule::kReach));
}

}  // namespace
}  // namespace priamos::head
