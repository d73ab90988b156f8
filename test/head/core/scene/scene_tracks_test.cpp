#include "head/core/scene/scene_tracks.hpp"

#include <gtest/gtest.h>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

SceneObject Object(ObjectKind kind, const Pose2& base_from_front, double width_m = 0.6) {
  SceneObject object;
  object.kind = kind;
  object.base_from_front = base_from_front;
  object.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  object.sigma_yaw_rad = 0.02;
  object.width_m = kind == ObjectKind::kEdge ? 0 : width_m;
  object.depth_m = kind == ObjectKind::kBox ? 0.4 : 0;
  object.top_m = 1;
  return object;
}

/// A look that shows these objects, and edges behind them.
struct Shows : Scene {
  Shows(std::initializer_list<SceneObject> seen) : Scene{test::HeadCamera(0, 1), seen, {}, {}} {}
  Shows& Behind(const Eigen::Vector3d& at) {
    edges.push_back({at, 1e-4 * Eigen::Matrix2d::Identity(), 200});
    return *this;
  }
};

TEST(SceneTracks, AnObjectIsBelievedWhenTwoPlacesShowIt) {
  SceneTracks dut;
  dut.Add(Shows{Object(ObjectKind::kFace, {2, 1, 0})}, {}, At(0));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_TRUE(dut.Tellables(At(0)).empty());
  dut.Add(Shows{Object(ObjectKind::kFace, {2, 1, 0})}, {}, At(1));
  EXPECT_TRUE(dut.Tellables(At(1)).empty()) << "the same picture errs in the same way";
  dut.Add(Shows{Object(ObjectKind::kFace, {1.5, 1, 0})}, {0.5, 0, 0}, At(2));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_EQ(dut.tracks()[0].looks, 3);
  EXPECT_EQ(dut.Tellables(At(2)).size(), 1u);
  EXPECT_TRUE(dut.Tellables(At(2000)).empty()) << "it was not seen for long";
}

TEST(SceneTracks, AFrontBecomesABoxWhenItsSideIsSeen) {
  SceneTracks dut;
  dut.Add(Shows{Object(ObjectKind::kFace, {2, 1, 0})}, {}, At(0));
  dut.Add(Shows{Object(ObjectKind::kBox, {1.8, 1, 0})}, {0.2, 0, 0}, At(1));
  dut.Add(Shows{Object(ObjectKind::kFace, {1.6, 1, 0})}, {0.4, 0, 0}, At(2));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_EQ(dut.tracks()[0].object.kind, ObjectKind::kBox);
  EXPECT_EQ(dut.tracks()[0].object.depth_m, 0.4);
}

TEST(SceneTracks, TwoSidesOfOneCornerAreTwoFronts) {
  SceneTracks dut;
  dut.Add(Shows{Object(ObjectKind::kFace, {2, 0.1, 0}), Object(ObjectKind::kFace, {2.1, 0, kPi / 2})}, {},
          At(0));
  EXPECT_EQ(dut.tracks().size(), 2u);
}

TEST(SceneTracks, AnEdgeGoesIntoTheFrontThatItBelongsTo) {
  SceneTracks dut;
  dut.Add(Shows{Object(ObjectKind::kEdge, {2, 0.3, 0}), Object(ObjectKind::kEdge, {2, 1.3, 0})}, {}, At(0));
  ASSERT_EQ(dut.tracks().size(), 2u);
  dut.Add(Shows{Object(ObjectKind::kFace, {2, 0, 0})}, {}, At(1));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_EQ(dut.tracks()[0].object.kind, ObjectKind::kEdge);
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.y, 1.3, 1e-9);
}

/// The top of a table.
SceneObject Top(const Pose2& base_from_front, double width_m = 1, double depth_m = 0.6) {
  SceneObject top = Object(ObjectKind::kBox, base_from_front, width_m);
  top.depth_m = depth_m;
  top.top_m = 0.72;
  top.bottom_m = 0.67;
  return top;
}

TEST(SceneTracks, ATopIsKnownByItsLargestPart) {
  SceneTracks dut;
  dut.Add(Shows{Top({2, 0, 0}, 0.5, 0.3)}, {}, At(0));
  dut.Add(Shows{Top({1.8, 0, 0})}, {0.2, 0, 0}, At(1));
  dut.Add(Shows{Top({1.6, 0.2, 0}, 0.5, 0.3)}, {0.4, 0, 0}, At(2));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_EQ(dut.tracks()[0].object.width_m, 1);
  EXPECT_EQ(dut.tracks()[0].looks, 3);
  EXPECT_EQ(dut.Urgent(At(2)).size(), 1u);
}

TEST(SceneTracks, ATopThatOnlyPartsWereSeenOfIsBelievedToo) {
  SceneTracks dut;
  dut.Add(Shows{Top({2, 0, 0})}, {}, At(0));
  dut.Add(Shows{Top({1.8, 0.2, 0}, 0.5, 0.3)}, {0.2, 0, 0}, At(1));
  EXPECT_EQ(dut.Urgent(At(1)).size(), 1u);
}

TEST(SceneTracks, ATopIsNoPartOfWhatStandsBelowIt) {
  SceneTracks dut;
  dut.Add(Shows{Top({2, 0, 0}), Object(ObjectKind::kFace, {2, 0, 0})}, {}, At(0));
  dut.Add(Shows{Top({1.8, 0, 0}), Object(ObjectKind::kFace, {1.8, 0, 0})}, {0.2, 0, 0}, At(1));
  EXPECT_EQ(dut.tracks().size(), 2u);
  EXPECT_EQ(dut.Urgent(At(1)).size(), 1u);
  EXPECT_EQ(dut.Tellables(At(1)).size(), 2u);
}

TEST(SceneTracks, ATopWhoseFrontIsMissingHasGone) {
  SceneTracks dut;
  Shows shows{Top({2.8, 0, 0})};
  shows.objects[0].top_m = 1;
  shows.objects[0].bottom_m = 0.95;
  dut.Add(shows, {}, At(0));
  shows.objects[0].base_from_front.x = 2.6;
  dut.Add(shows, {0.2, 0, 0}, At(1));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_FALSE(dut.HasGone(dut.tracks()[0]));
  dut.Add(Shows{}, {0.4, 0, 0}, At(2));
  dut.Add(Shows{}, {0.6, 0, 0}, At(3));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_TRUE(dut.HasGone(dut.tracks()[0]));
}

TEST(SceneTracks, WhatLooksSeeThroughHasGone) {
  SceneTracks dut;
  dut.Add(Shows{Object(ObjectKind::kFace, {3, 0, 0})}, {}, At(0));
  dut.Add(Shows{Object(ObjectKind::kFace, {2.8, 0, 0})}, {0.2, 0, 0}, At(1));
  ASSERT_EQ(dut.Tellables(At(1)).size(), 1u);
  dut.Add(Shows{}.Behind({4, 0, 0.6}), {0.2, 0, 0}, At(2));
  EXPECT_FALSE(dut.HasGone(dut.tracks().at(0))) << "one look may err";
  dut.Add(Shows{}.Behind({4, 0, 0.6}), {0.2, 0, 0}, At(3));
  ASSERT_TRUE(dut.HasGone(dut.tracks().at(0)));
  EXPECT_EQ(dut.Tellables(At(3)).size(), 1u) << "that it has gone is told";
  dut.Add(Shows{}, {0.2, 0, 0}, At(100));
  EXPECT_TRUE(dut.tracks().empty());
}

TEST(SceneTracks, WhatIsHiddenOrOutOfSightStays) {
  SceneTracks dut;
  dut.Add(Shows{Object(ObjectKind::kFace, {3, 0, 0})}, {}, At(0));
  dut.Add(Shows{Object(ObjectKind::kFace, {2.8, 0, 0})}, {0.2, 0, 0}, At(1));
  for (int i = 2; i < 6; ++i) dut.Add(Shows{}.Behind({2, 0, 0.8}), {0.2, 0, 0}, At(i));  // before it
  for (int i = 6; i < 9; ++i) dut.Add(Shows{}.Behind({4, 2, 0.6}), {0.2, 0, 0}, At(i));  // beside it
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_FALSE(dut.HasGone(dut.tracks()[0]));
}

TEST(SceneTracks, WhatComesBackIsAnotherOne) {
  SceneTracks dut;
  for (int i = 0; i < 2; ++i)
    dut.Add(Shows{Object(ObjectKind::kFace, {3 - 0.2 * i, 0, 0})}, {0.2 * i, 0, 0}, At(i));
  for (int i = 2; i < 4; ++i) dut.Add(Shows{}.Behind({4, 0, 0.6}), {0.2, 0, 0}, At(i));
  dut.Add(Shows{Object(ObjectKind::kFace, {2.8, 0, 0})}, {0.2, 0, 0}, At(5));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_NE(dut.tracks()[0].id, dut.tracks()[1].id);
}

TEST(SceneTracks, ForgetsAndKeepsNoMoreThanItMay) {
  SceneTrackOptions options;
  options.most = 2;
  SceneTracks dut(options);
  for (int i = 0; i < 3; ++i) dut.Add(Shows{Object(ObjectKind::kFace, {2.0 + i, 1, 0})}, {}, At(i));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.x, 3, 1e-9) << "the oldest has gone";
  dut.Forget();
  EXPECT_TRUE(dut.tracks().empty());
}

TEST(SceneTracks, AnObjectThatKnowsNothingOfItsPlaceIsLeftOut) {
  SceneTracks dut;
  SceneObject vague = Object(ObjectKind::kFace, {2, 1, 0});
  vague.covariance *= 1000;
  dut.Add(Shows{vague}, {}, At(0));
  EXPECT_TRUE(dut.tracks().empty());
}

}  // namespace
}  // namespace priamos::head
