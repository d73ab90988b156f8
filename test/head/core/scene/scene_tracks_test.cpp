#include "head/core/scene/scene_tracks.hpp"

#include <gtest/gtest.h>

#include <array>

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

TEST(SceneTracks, AnObjectIsBelievedWhenTwoPlacesShowIt) {
  SceneTracks dut;
  dut.Add(std::array{Object(ObjectKind::kFace, {2, 1, 0})}, {}, At(0));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_TRUE(dut.Tellables(At(0)).empty());
  dut.Add(std::array{Object(ObjectKind::kFace, {2, 1, 0})}, {}, At(1));
  EXPECT_TRUE(dut.Tellables(At(1)).empty()) << "the same picture errs in the same way";
  dut.Add(std::array{Object(ObjectKind::kFace, {1.5, 1, 0})}, {0.5, 0, 0}, At(2));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_EQ(dut.tracks()[0].looks, 3);
  EXPECT_EQ(dut.Tellables(At(2)).size(), 1u);
  EXPECT_TRUE(dut.Tellables(At(2000)).empty()) << "it was not seen for long";
}

TEST(SceneTracks, AFrontBecomesABoxWhenItsSideIsSeen) {
  SceneTracks dut;
  dut.Add(std::array{Object(ObjectKind::kFace, {2, 1, 0})}, {}, At(0));
  dut.Add(std::array{Object(ObjectKind::kBox, {1.8, 1, 0})}, {0.2, 0, 0}, At(1));
  dut.Add(std::array{Object(ObjectKind::kFace, {1.6, 1, 0})}, {0.4, 0, 0}, At(2));
  ASSERT_EQ(dut.tracks().size(), 1u);
  EXPECT_EQ(dut.tracks()[0].object.kind, ObjectKind::kBox);
  EXPECT_EQ(dut.tracks()[0].object.depth_m, 0.4);
}

TEST(SceneTracks, TwoSidesOfOneCornerAreTwoFronts) {
  SceneTracks dut;
  dut.Add(std::array{Object(ObjectKind::kFace, {2, 0.1, 0}), Object(ObjectKind::kFace, {2.1, 0, kPi / 2})},
          {}, At(0));
  EXPECT_EQ(dut.tracks().size(), 2u);
}

TEST(SceneTracks, AnEdgeGoesIntoTheFrontThatItBelongsTo) {
  SceneTracks dut;
  dut.Add(std::array{Object(ObjectKind::kEdge, {2, 0.3, 0}), Object(ObjectKind::kEdge, {2, 1.3, 0})}, {},
          At(0));
  ASSERT_EQ(dut.tracks().size(), 2u);
  dut.Add(std::array{Object(ObjectKind::kFace, {2, 0, 0})}, {}, At(1));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_EQ(dut.tracks()[0].object.kind, ObjectKind::kEdge);
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.y, 1.3, 1e-9);
}

TEST(SceneTracks, ForgetsAndKeepsNoMoreThanItMay) {
  SceneTrackOptions options;
  options.most = 2;
  SceneTracks dut(options);
  for (int i = 0; i < 3; ++i) dut.Add(std::array{Object(ObjectKind::kFace, {2.0 + i, 1, 0})}, {}, At(i));
  ASSERT_EQ(dut.tracks().size(), 2u);
  EXPECT_NEAR(dut.tracks()[0].place.map_from_thing.x, 3, 1e-9) << "the oldest has gone";
  dut.Forget();
  EXPECT_TRUE(dut.tracks().empty());
}

TEST(SceneTracks, AnObjectThatKnowsNothingOfItsPlaceIsLeftOut) {
  SceneTracks dut;
  SceneObject vague = Object(ObjectKind::kFace, {2, 1, 0});
  vague.covariance *= 1000;
  dut.Add(std::array{vague}, {}, At(0));
  EXPECT_TRUE(dut.tracks().empty());
}

}  // namespace
}  // namespace priamos::head
