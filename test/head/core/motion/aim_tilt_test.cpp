#include "head/core/motion/aim_tilt.hpp"

#include <gtest/gtest.h>

#include "test/head/core/motion/aimed_head.hpp"

namespace priamos::head {
namespace {

LandmarkModel Opening(double height_m) {
  LandmarkModel model;
  for (const double y : {0.45, -0.45}) model.edges.push_back({{0, y, 0}, {0, y, height_m}});
  model.edges.push_back({{0, -0.45, height_m}, {0, 0.45, height_m}});
  model.edges.push_back(
      {{0.1, -0.45, height_m + 0.1}, {0.1, 0.45, height_m + 0.1}, -0.1, 0.1});  // from behind
  return model;
}

const HeadSetting kLooks{0, Radians(-5), {-0.02, 0.02}, {250, 250}, {1600, 1600}};

double RowOfTop(double tilt_rad, double distance_m, double height_m) {
  HeadSetting setting = kLooks;
  setting.tilt_rad = tilt_rad;
  return HeadOfOneLens().CameraAt(setting, kLeft)->Project({distance_m, 0, height_m}).y();
}

TEST(AimTilt, FromAfarTheTiltStaysAsItIs) {
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, Opening(2), {3.4, 0, 0}, {}), kLooks.tilt_rad);
}

TEST(AimTilt, FromNearItLooksJustAsFarUpAsTheLintelNeeds) {
  double last = kLooks.tilt_rad;
  for (const double distance_m : {2.2, 1.9, 1.7}) {
    const double tilt = AimTilt(HeadOfOneLens(), kLooks, Opening(2), {distance_m, 0, 0}, {});
    EXPECT_LT(tilt, last) << distance_m;
    EXPECT_GE(RowOfTop(tilt, distance_m, 2), 30) << distance_m;
    EXPECT_LT(RowOfTop(tilt, distance_m, 2), 45) << distance_m;
    last = tilt;
  }
}

TEST(AimTilt, ALintelThatIsOutOfReachChangesNothing) {
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, Opening(2), {0.6, 0, 0}, {}), kLooks.tilt_rad);
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, Opening(2), {1.7, 0, 0}, {.most_deg = 5}), kLooks.tilt_rad);
}

TEST(AimTilt, ADrivingBaseLooksAsFarUpAsTheNextLookNeeds) {
  const Pose2 now{1.7, 0, 0}, next{1.4, 0, 0}, far{0.9, 0, 0};
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, Opening(2), now, next, {}),
            AimTilt(HeadOfOneLens(), kLooks, Opening(2), next, {}));
  // But not so far that the lintel sinks below the middle of the picture.
  const double tilt = AimTilt(HeadOfOneLens(), kLooks, Opening(2), now, far, {});
  EXPECT_GT(tilt, AimTilt(HeadOfOneLens(), kLooks, Opening(2), far, {}));
  EXPECT_LT(RowOfTop(tilt, now.x, 2), 288);
}

TEST(AimTilt, OfEdgesThatCannotAllBeShownThoseThatCanCount) {
  LandmarkModel with_frame = Opening(2);
  with_frame.edges.push_back({{-0.1, -0.5, 2.3}, {-0.1, 0.5, 2.3}});
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, with_frame, {0.8, 0, 0}, {}),
            AimTilt(HeadOfOneLens(), kLooks, Opening(2), {0.8, 0, 0}, {}));
}

TEST(AimTilt, CountsTheLevelEdgesInBothPictures) {
  const auto shown = [](double tilt_deg) {
    HeadSetting setting = kLooks;
    setting.tilt_rad = Radians(tilt_deg);
    return LevelEdgesShown(HeadOfOneLens(), setting, Opening(2), {1, 0, 0}, {});
  };
  EXPECT_EQ(shown(-5), 0);
  EXPECT_EQ(shown(-40), 1);
}

TEST(AimTilt, WithoutLevelEdgesOrBehindTheBaseItChangesNothing) {
  LandmarkModel jambs = Opening(2);
  jambs.edges.resize(2);
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, jambs, {1.7, 0, 0}, {}), kLooks.tilt_rad);
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, LandmarkModel{}, {1.7, 0, 0}, {}), kLooks.tilt_rad);
}

TEST(AimTilt, WhatIsSeenFromTheOtherSideOnlyDoesNotCount) {
  LandmarkModel without = Opening(2);
  without.edges.pop_back();
  EXPECT_EQ(AimTilt(HeadOfOneLens(), kLooks, Opening(2), {1.8, 0, 0}, {}),
            AimTilt(HeadOfOneLens(), kLooks, without, {1.8, 0, 0}, {}));
}

}  // namespace
}  // namespace priamos::head
