#include "head/core/stereo/grey_relation.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "head/core/stereo/edge_stereo.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/space_scene.hpp"

namespace priamos::head {
namespace {

using support::Between;
using test::SpaceScene;

constexpr GreyRelation kOthers[] = {
    {.gain = 0.5},
    {.gain = 0.7, .offset = 20},
    {.gain = 1.3},
    {.gain = 2, .offset = -130},
    {.offset = -40},
    {.gamma = 0.6},
    {.gain = 1.1, .gamma = 1.7},
    {.falloff_second = -0.5},
    {.gain = 0.8, .gamma = 0.8, .offset = 15, .falloff_first = 0.3, .falloff_second = -0.4},
};

/// A room whose second camera has other grey values.
struct OtherLight {
  OtherLight(const GreyRelation& relation, std::uint64_t seed) : rng(seed), scene({}, rng) {
    for (std::size_t i = 0; i < scene.views[1].lines.size(); ++i) {
      EdgeSegment& segment = scene.images[1].segments[scene.views[1].lines[i].segment];
      const double far = FarFromCentre(scene.views[1], scene.views[1].lines[i]);
      segment.grey_left = relation.Of(segment.grey_left, far, far);
      segment.grey_right = relation.Of(segment.grey_right, far, far);
    }
  }
  /// Right and wrong matches with a place in space.
  std::pair<int, int> Matches() const {
    int right = 0, wrong = 0;
    for (const StereoMatch& m : MatchBinocular(scene.views[0], scene.views[1], {})) {
      const int edge = scene.truth[0][m.left];
      if (m.space) (edge >= 0 && edge == scene.truth[1][m.right.front()] ? right : wrong)++;
    }
    return {right, wrong};
  }

  Rng rng;
  SpaceScene scene;
};

TEST(GreyRelationTest, UnchangedUnlessToldOtherwise) {
  for (const double grey : {1.0, 40.0, 128.0, 255.0})
    EXPECT_DOUBLE_EQ(GreyRelation().Of(grey, 0.3, 0.9), grey);
  EXPECT_DOUBLE_EQ(GreyRelation().Slope(), 1);
}

TEST(GreyRelationTest, LightIsScaledBentAndShiftedInThisOrder) {
  EXPECT_DOUBLE_EQ(GreyRelation({.gain = 0.5, .offset = 10}).Of(100), 60);
  EXPECT_NEAR(GreyRelation({.gamma = 2}).Of(127.5), 63.75, 1e-9);
  EXPECT_DOUBLE_EQ(GreyRelation({.gain = 2}).Of(200), 255) << "white stays white";
  EXPECT_DOUBLE_EQ(GreyRelation({.offset = -50}).Of(20), 0);
}

TEST(GreyRelationTest, CornersMayBeDarker) {
  const GreyRelation dut{.falloff_second = -0.4};
  EXPECT_DOUBLE_EQ(dut.Of(100, 1, 0), 100);
  EXPECT_DOUBLE_EQ(dut.Of(100, 0, 1), 60);
  EXPECT_DOUBLE_EQ(dut.Slope(0, 1), 0.6);
}

RC_GTEST_PROP(GreyRelationTest, WhatIsBrighterStaysSo, ()) {
  const GreyRelation dut{.gain = Between(0.3, 3),
                         .gamma = Between(0.4, 2.5),
                         .offset = Between(-60, 60),
                         .falloff_first = Between(-0.7, 1.5),
                         .falloff_second = Between(-0.7, 1.5)};
  const double grey = Between(0, 254), far = Between(0, 1);
  RC_ASSERT(dut.Of(grey, far, far) <= dut.Of(grey + 1, far, far));
  RC_ASSERT(dut.Of(grey, far, far) >= 0 && dut.Of(grey, far, far) <= 255);
}

TEST(EstimateGreyRelationTest, EqualCamerasStayAsTheyAre) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OtherLight room({}, seed);
    const GreyRelation dut = RelationOf(room.scene.views[0], room.scene.views[1], {});
    for (const double grey : {70.0, 110.0, 150.0, 190.0})
      EXPECT_NEAR(dut.Of(grey, 0.3, 0.3), grey, 3) << seed;
  }
}

TEST(EstimateGreyRelationTest, FindsHowTheCamerasDiffer) {
  for (const GreyRelation& relation : kOthers)
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const OtherLight room(relation, seed);
      const GreyRelation dut = RelationOf(room.scene.views[0], room.scene.views[1], {});
      for (const double grey : {70.0, 110.0, 150.0, 190.0})
        EXPECT_NEAR(dut.Of(grey, 0.3, 0.3), relation.Of(grey, 0.3, 0.3), 10)
            << "gain " << relation.gain << ", gamma " << relation.gamma << ", offset " << relation.offset
            << ", seed " << seed;
    }
}

TEST(EstimateGreyRelationTest, MatchesAreWhatTheyAreWithEqualCameras) {
  for (const GreyRelation& relation : kOthers) {
    int right = 0, wrong = 0, right_of_equal = 0, wrong_of_equal = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto [r, w] = OtherLight(relation, seed).Matches();
      const auto [r0, w0] = OtherLight({}, seed).Matches();
      right += r, wrong += w, right_of_equal += r0, wrong_of_equal += w0;
    }
    EXPECT_GE(right, 0.9 * right_of_equal)
        << "gain " << relation.gain << ", gamma " << relation.gamma << ", offset " << relation.offset;
    EXPECT_LE(wrong, 1.2 * wrong_of_equal)
        << "gain " << relation.gain << ", gamma " << relation.gamma << ", offset " << relation.offset;
  }
}

TEST(EstimateGreyRelationTest, WithoutPairsNothingIsKnown) {
  const OtherLight room({.gain = 0.5}, 1);
  const GreyRelation dut = EstimateGreyRelation(room.scene.views[0], room.scene.views[1], {});
  EXPECT_EQ(dut.gain, 1);
  EXPECT_EQ(dut.offset, 0);
}

}  // namespace
}  // namespace priamos::head
