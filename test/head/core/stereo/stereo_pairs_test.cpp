#include "head/core/stereo/stereo_pairs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;
using support::Between;
using test::ExactView;

class StereoPairsTest : public testing::Test {
 protected:
  void SeeBoth(const Vector3d& from, const Vector3d& to) { left_.See(from, to), right_.See(from, to); }
  std::vector<StereoPair> Pairs(const StereoOptions& options = {}) {
    return FindPairs(left_.View(), right_.View(), options);
  }
  ExactView left_{test::HeadCamera(0, 1)}, right_{test::HeadCamera(0, -1)};
};

/// A point of a vertical edge 2.75 m before the cameras.
Vector3d At(double z, double y = 0.1) {
  return {3, y, z};
}

TEST_F(StereoPairsTest, OneEdgeInBothImagesIsAPair) {
  SeeBoth(At(0.9), At(1.6));
  const auto dut = Pairs();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].first, 0);
  EXPECT_EQ(dut[0].second, 0);
  EXPECT_NEAR(dut[0].similarity, 1, 0.01);
  EXPECT_NEAR(dut[0].epipolar_rad, kPi / 2, 0.05);
}

TEST_F(StereoPairsTest, AllThatCouldBeOneEdgeArePairs) {
  SeeBoth(At(0.9, 0), At(1.6, 0));
  SeeBoth(At(0.9, 0.1), At(1.6, 0.1));
  EXPECT_EQ(Pairs().size(), 4u) << "nothing but their depth tells the four apart";
}

TEST_F(StereoPairsTest, TheImagesMayChangePlaces) {
  SeeBoth(At(0.9), At(1.6));
  SeeBoth(At(0.9, 0.4), At(1.5, 0.2));
  const auto there = Pairs(), back = FindPairs(right_.View(), left_.View(), {});
  ASSERT_EQ(there.size(), back.size());
  for (const StereoPair& pair : there) {
    const bool found = std::any_of(back.begin(), back.end(), [&](const StereoPair& other) {
      return other.first == pair.second && other.second == pair.first &&
             std::abs(other.epipolar_rad - pair.epipolar_rad) < 1e-9;
    });
    EXPECT_TRUE(found) << pair.first << ' ' << pair.second;
  }
}

TEST_F(StereoPairsTest, OppositeContrastIsAnotherEdge) {
  left_.See(At(0.9), At(1.6));
  right_.See(At(1.6), At(0.9));
  EXPECT_TRUE(Pairs().empty());
}

TEST_F(StereoPairsTest, DepthHasBounds) {
  SeeBoth(At(0.9), At(1.6));  // 2.75 m
  EXPECT_EQ(Pairs({.max_depth_m = 2.8}).size(), 1u);
  EXPECT_TRUE(Pairs({.max_depth_m = 2.7}).empty());
  EXPECT_EQ(Pairs({.min_depth_m = 2.7}).size(), 1u);
  EXPECT_TRUE(Pairs({.min_depth_m = 2.8}).empty());
}

TEST_F(StereoPairsTest, LinesOfSightThatMeetBehindTheCamerasAreNoPair) {
  left_.See(At(0.9, 0.4), At(1.6, 0.4));
  right_.See(At(0.9, -0.4), At(1.6, -0.4));
  EXPECT_TRUE(Pairs().empty());
}

TEST_F(StereoPairsTest, TheCommonExtentCounts) {
  left_.See(At(0.9), At(1.5));
  right_.See(At(1.2), At(1.8));
  EXPECT_TRUE(Pairs({.min_overlap = 0.55}).empty());
  const auto half = Pairs({.min_overlap = 0.45});
  ASSERT_EQ(half.size(), 1u);
  EXPECT_NEAR(half[0].similarity, 0.5, 0.02);
}

TEST_F(StereoPairsTest, AShortLineIsAllOfTheLongOneThatItShows) {
  left_.See(At(0.8), At(1.6));
  right_.See(At(1.0), At(1.2));
  const auto dut = Pairs();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0].similarity, std::sqrt(0.2 / 0.8), 0.02);
}

TEST_F(StereoPairsTest, WithoutACommonExtentTheyAreNoPair) {
  left_.See(At(0.6), At(1.0));
  right_.See(At(1.1), At(1.5));
  EXPECT_TRUE(Pairs().empty());
}

TEST_F(StereoPairsTest, NoCameraSeesAnEdgeVeryDifferently) {
  SeeBoth(At(0.9), At(1.6));
  const double between = 2 * std::atan(0.15 / 2.75);  // of the planes of sight, for an edge in the middle
  EXPECT_EQ(Pairs({.max_turn_rad = 1.05 * between}).size(), 1u);
  EXPECT_TRUE(Pairs({.max_turn_rad = 0.95 * between}).empty());
}

TEST_F(StereoPairsTest, AlongTheEpipolarLineOnlyTheLineMustBeTheSame) {
  left_.See({3, 0.3, 1.6}, {3, 0.0, 1.6});
  right_.See({3, 0.1, 1.6}, {3, -0.3, 1.6});
  const auto dut = Pairs();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_LT(dut[0].epipolar_rad, StereoOptions().min_epipolar_rad);
  right_.edges().segments.clear();
  right_.edges().points.clear();
  right_.See({3, 0.1, 1.7}, {3, -0.3, 1.7});  // 36 px higher
  EXPECT_TRUE(Pairs().empty());
}

TEST_F(StereoPairsTest, NothingSeenNoPairs) {
  left_.See(At(0.9), At(1.6));
  EXPECT_TRUE(Pairs().empty());
  EXPECT_TRUE(FindPairs(right_.View(), left_.View(), {}).empty());
}

/// How alike two edges of these grey values are, left and right of them.
double Similarity(double left_a, double right_a, double left_b, double right_b,
                  const StereoOptions& options = {}) {
  ExactView a(test::HeadCamera(0, 1)), b(test::HeadCamera(0, -1));
  a.See(At(0.9), At(1.6), left_a, right_a);
  b.See(At(0.9), At(1.6), left_b, right_b);
  return GreySimilarity(a.View(), 0, b.View(), 0, {}, options);
}

TEST(GreySimilarityTest, TheSameGreyValuesAreAsAlikeAsCanBe) {
  EXPECT_DOUBLE_EQ(Similarity(80, 140, 80, 140), 1);
}

TEST(GreySimilarityTest, OneSideMayDifferBecauseItIsFarther) {
  EXPECT_GT(Similarity(80, 140, 60, 140), 0.5);
  EXPECT_GT(Similarity(80, 140, 60, 140), Similarity(80, 140, 60, 120)) << "both sides differ";
  EXPECT_GT(Similarity(80, 140, 81, 190, {.max_contrast_ratio = 3}), 0) << "50 on the worse side";
}

TEST(GreySimilarityTest, TheBetterSideMustAgree) {
  EXPECT_GT(Similarity(80, 140, 99, 160), 0);
  EXPECT_EQ(Similarity(80, 140, 101, 161), 0);
  EXPECT_GT(Similarity(80, 140, 101, 161, {.max_grey_difference = 25}), 0);
}

TEST(GreySimilarityTest, TheContrastsMayDifferUpToARatio) {
  EXPECT_GT(Similarity(80, 140, 80, 199), 0);
  EXPECT_EQ(Similarity(80, 140, 80, 201), 0);
  EXPECT_EQ(Similarity(80, 201, 80, 140), 0) << "either way";
  EXPECT_GT(Similarity(80, 201, 80, 140, {.max_contrast_ratio = 2.1}), 0);
}

RC_GTEST_PROP(GreySimilarityTest, IsBetween0And1AndTheSameBothWays, ()) {
  const double a = Between(0, 120), b = a + Between(5, 120), c = Between(0, 120), d = c + Between(5, 120);
  const double there = Similarity(a, b, c, d), back = Similarity(c, d, a, b);
  RC_ASSERT(there >= 0 && there <= 1);
  RC_ASSERT(std::abs(there - back) < 1e-12);
}

}  // namespace
}  // namespace priamos::head
