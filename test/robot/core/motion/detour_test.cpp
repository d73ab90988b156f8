#include "robot/core/motion/detour.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

constexpr Leeway kWide{1.5, 1.5};

PathShape Straight(const Leeway& leeway, double length_m = 4) {
  return {
      PathShapeConfig{}, {}, {.id = 1, .speed_m_s = 0.3, .points = {{length_m, 0, 0}}, .leeway = {leeway}}};
}

/// Points along the outline of an upright square.
std::vector<Eigen::Vector2d> Square(double x, double y, double half) {
  std::vector<Eigen::Vector2d> points;
  for (double t = -half; t <= half + 1e-9; t += 0.05)
    for (const double side : {-half, half}) {
      points.emplace_back(x + t, y + side);
      points.emplace_back(x + side, y + t);
    }
  return points;
}

class DetourTest : public testing::Test {
 protected:
  std::optional<Detour> Find(const PathShape& path, const std::vector<Eigen::Vector2d>& things,
                             const PathPlace& here = {}, const Detour& last = {}) const {
    return FindDetour(config_, footprint_, path, here, things, last);
  }
  double GapAt(const PathShape& path, const Detour& detour, double s,
               const std::vector<Eigen::Vector2d>& things) const {
    const PathShape::Point point = path.At(s);
    const Eigen::Vector2d at = point.pose.translation() + point.left() * detour.At(s);
    double gap = 9;
    for (const auto& thing : things)
      gap = std::min(gap, footprint_.Distance(Pose2{at.x(), at.y(), point.pose.yaw}.Inverse() * thing));
    return gap;
  }

  DetourConfig config_;
  Footprint footprint_;
};

TEST_F(DetourTest, StaysOnAFreePath) {
  const auto detour = Find(Straight(kWide), Square(2, 1.5, 0.2));
  ASSERT_TRUE(detour);
  EXPECT_FALSE(detour->leaves());
}

TEST_F(DetourTest, GoesAroundABoxAndComesBack) {
  const PathShape path = Straight(kWide);
  const auto box = Square(1.4, 0.05, 0.15);
  const auto detour = Find(path, box);
  ASSERT_TRUE(detour);
  EXPECT_LT(detour->At(1.4), -0.6) << "to the right, where it is nearer";
  EXPECT_NEAR(detour->At(0), 0, 1e-9);
  for (double s = 0.3; s < 2.4; s += 0.05) EXPECT_GT(GapAt(path, *detour, s, box), 0.1) << s;
}

TEST_F(DetourTest, WhatStandsBesideADoorwayDoesNotKeepItOffTheWayThroughIt) {
  const PathShape path{PathShapeConfig{},
                       {},
                       {.id = 1, .speed_m_s = 0.3, .points = {{2, 0, 0}, {4, 0, 0}}, .leeway = {kWide, {}}}};
  for (const double beside_m : {0.01, 0.05, 0.1}) {  // an open leaf, as echoes have it
    std::vector<Eigen::Vector2d> leaf;
    for (double x = 2.3; x < 4.5; x += 0.05) leaf.emplace_back(x, footprint_.width_m / 2 + beside_m);
    for (const auto& here : {PathPlace{2.0, -0.25}, PathPlace{2.6, -0.05}}) {
      const auto detour = Find(path, leaf, here, Detour(0, 5, {here.offset_m, here.offset_m}));
      ASSERT_TRUE(detour);
      EXPECT_NEAR(detour->At(here.s + 0.6), 0, 0.005) << beside_m;
    }
  }
}

TEST_F(DetourTest, GoesWhereThereIsLeeway) {
  const auto detour = Find(Straight({1.5, 0.3}), Square(1.4, 0.05, 0.15));
  ASSERT_TRUE(detour);
  EXPECT_GT(detour->At(1.4), 0.6);
}

TEST_F(DetourTest, EndsBeforeABoxWhereThereIsNoRoom) {
  const auto detour = Find(Straight({0.3, 0.3}), Square(1.4, 0, 0.15));
  EXPECT_LE(std::abs(detour.value_or(Detour()).At(2.5)), 0.3);
}

TEST_F(DetourTest, InANarrowPassageItKeepsToTheMiddleOfWhatSeemsToCloseIt) {
  // Two jambs 1.05 m apart, 8 cm to the left of the path, each smeared by 15 cm.
  std::vector<Eigen::Vector2d> jambs;
  for (double y = 0; y <= 0.15; y += 0.05)
    for (double x = 1.9; x <= 2.1; x += 0.05) {
      jambs.emplace_back(x, 0.08 + 0.525 - y);
      jambs.emplace_back(x, 0.08 - 0.525 + y);
    }
  const auto narrow = Find(Straight(kNarrowLine), jambs);
  ASSERT_TRUE(narrow);
  EXPECT_NEAR(narrow->At(2), 0.08, 0.05);
  EXPECT_NEAR(narrow->At(4), 0, 0.05);
}

TEST_F(DetourTest, WithoutLeewayItStaysOnThePath) {
  const auto detour = Find(Straight({}), Square(1.4, 0.3, 0.15));
  EXPECT_FALSE(detour.value_or(Detour()).leaves());
}

TEST_F(DetourTest, GoesStraightToTheSideFromRightBeforeABox) {
  const double x = footprint_.length_m / 2 + 0.13 + 0.15;
  const auto detour = Find(Straight(kWide), Square(x, 0.05, 0.15));
  ASSERT_TRUE(detour);
  EXPECT_LT(detour->At(0), -0.4) << "at once, before it goes on";
}

TEST_F(DetourTest, KeepsTheSideThatItHasChosen) {
  const PathShape path = Straight(kWide);
  const auto first = Find(path, Square(1.4, 0.05, 0.15));
  ASSERT_TRUE(first);
  const auto second = Find(path, Square(1.4, -0.05, 0.15), {0.3, first->At(0.3)}, *first);
  ASSERT_TRUE(second);
  EXPECT_LT(second->At(1.4), -0.6);
}

TEST_F(DetourTest, ComesBackWhereTheLeewayEnds) {
  const PathShape path(PathShapeConfig{}, {},
                       {.id = 1, .speed_m_s = 0.3, .points = {{1, 0, 0}, {4, 0, 0}}, .leeway = {kWide, {}}});
  const Detour last(0, 0.05, std::vector<double>(60, 0.5));
  const auto detour = Find(path, Square(0.2, -0.5, 0.2), {0.9, 0.5}, last);
  ASSERT_TRUE(detour);
  EXPECT_NEAR(detour->At(1.5), 0, 0.06);
}

TEST_F(DetourTest, MissesAnEndThatIsNotFree) {
  const PathShape path = Straight(kWide, 2);
  const auto detour = Find(path, Square(2, 0, 0.2));
  ASSERT_TRUE(detour);
  EXPECT_GT(std::abs(detour->At(2)), 0.6);
}

TEST_F(DetourTest, FromBesideItsEndItGoesBackToIt) {
  const PathShape path(
      PathShapeConfig{}, {},
      {.id = 1, .speed_m_s = 0.3, .points = {{3.4, 0, 0}, {4, 0, 0}}, .leeway = {kWide, {}}});
  const Detour last(0, 0.05, std::vector<double>(81, 0.55));
  for (const double left_m : {0.03, 0.0}) {
    const auto detour = Find(path, Square(2, -0.5, 0.2), {path.length() - left_m, 0.55}, last);
    ASSERT_TRUE(detour) << left_m;
    EXPECT_NEAR(detour->At(path.length()), 0, 0.03) << left_m;
  }
}

TEST_F(DetourTest, GoesBackToItsEndAlsoPastAThingThatIsNear) {
  // A post 6 cm behind the base at the end of its path, and so all the way there from beside it.
  const PathShape path = Straight(kWide);
  std::vector<Eigen::Vector2d> post;
  for (double y = 0.2; y < 0.5; y += 0.05) post.emplace_back(4 - 0.475 - 0.06, y);
  const auto detour = Find(path, post, {4, 0.6}, Detour(3, 0.5, {0.6, 0.6, 0.6}));
  ASSERT_TRUE(detour);
  EXPECT_TRUE(detour->leads_on());
  EXPECT_NEAR(detour->At(4), 0, 0.06);
}

TEST_F(DetourTest, BeginsWhereTheBaseIsAndNotInTheMiddleOfALane) {
  const PathShape path = Straight(kWide);
  const auto detour =
      Find(path, Square(2, 0, 0.2), {0.6, 0.424}, Detour(0, 0.05, std::vector<double>(60, 0.4)));
  ASSERT_TRUE(detour);
  EXPECT_NEAR(detour->At(0.6), 0.424, 0.005);
}

RC_GTEST_PROP(Detour, TakesThingsAnywhereAndHeadingsAlmostStraight, (const unsigned seed)) {
  Rng rng(seed);
  const double turn = std::pow(10.0, rng.Uniform(-12, 0));
  const PathShape path(
      PathShapeConfig{}, {0, 0, turn},
      {.id = 1, .speed_m_s = 0.3, .points = {{4, 0, turn * rng.Uniform(-1, 1)}}, .leeway = {kWide}});
  std::vector<Eigen::Vector2d> things;
  for (int i = 0; i < 50; ++i)
    things.emplace_back(rng.Uniform(-1, 1) * std::pow(10.0, rng.Uniform(-2, 9)), rng.Uniform(-3, 3));
  const auto detour = FindDetour({}, {}, path, {rng.Uniform(0, 4), rng.Uniform(-9, 9)}, things, {});
  RC_ASSERT(!detour || std::isfinite(detour->At(rng.Uniform(0, 4))));
}

RC_GTEST_PROP(Detour, StaysWithinItsLeeway, (const unsigned seed)) {
  Rng rng(seed);
  const Leeway leeway{rng.Uniform(0, 2), rng.Uniform(0, 2)};
  const PathShape path = Straight(leeway);
  std::vector<Eigen::Vector2d> things;
  for (int i = 0; i < 3; ++i)
    for (const auto& p : Square(rng.Uniform(0.9, 3), rng.Uniform(-1, 1), rng.Uniform(0.02, 0.3)))
      things.push_back(p);
  const DetourConfig config;
  const Footprint footprint;
  const auto detour = FindDetour(config, footprint, path, {}, things, {});
  RC_PRE(detour.has_value());
  for (double s = 0; s < 2.4; s += 0.05) {
    RC_ASSERT(detour->At(s) <= leeway.left_m + 1e-9);
    RC_ASSERT(detour->At(s) >= -leeway.right_m - 1e-9);
  }
}

TEST(Detour, BetweenItsPlacesItIsStraight) {
  const Detour detour(1, 0.5, {0, 0.5, 0.5});
  EXPECT_DOUBLE_EQ(detour.At(0), 0);
  EXPECT_DOUBLE_EQ(detour.At(1.25), 0.25);
  EXPECT_DOUBLE_EQ(detour.At(9), 0.5);
  EXPECT_NEAR(detour.SlopeAt(1.25), 1, 1e-9);
  EXPECT_TRUE(detour.leaves());
  EXPECT_FALSE(Detour().leaves());
}

}  // namespace
}  // namespace priamos::robot
