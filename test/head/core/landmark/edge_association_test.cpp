#include "head/core/landmark/edge_association.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

/// An upright edge 3 m ahead and a level one that begins at its upper end, and images made of straight lines.
class EdgeAssociationTest : public testing::Test {
 protected:
  EdgeAssociationTest() {
    model_.edges.push_back({{3, 0, 0.8}, {3, 0, 1.6}, -kPi, kPi, 0});
    model_.edges.push_back({{3, 0, 1.6}, {3, 0.7, 1.6}, -kPi, kPi, 0});
    edges_.width = 768;
    edges_.height = 576;
  }

  /// Draws model edge `index`, `beside_px` to its right hand, its end at the corner cut by `cut_px`, with
  /// these grey values on its hands.
  void Draw(int index, double beside_px, double cut_px, double grey_left, double grey_right) {
    const LandmarkEdge& edge = model_.edges[index];
    const auto seen = ProjectEdge(camera_, {768, 576}, edge.from, edge.to);
    ASSERT_TRUE(seen);
    const Eigen::Vector2d along = seen->direction(), shift = beside_px * seen->normal();
    Eigen::Vector2d p = seen->p + shift, q = seen->q + shift;
    (index == 0 ? q : p) += (index == 0 ? -cut_px : cut_px) * along;
    EdgeSegment segment;
    segment.begin = grey_right > grey_left ? p : q;
    segment.end = grey_right > grey_left ? q : p;
    segment.centre = (p + q) / 2;
    segment.sigma_normal_px = 0.05;
    segment.sigma_angle_rad = 0.001;
    segment.grey_left = std::min(grey_left, grey_right);
    segment.grey_right = std::max(grey_left, grey_right);
    edges_.segments.push_back(segment);
  }

  Association Look() {
    const std::array<CameraView, 1> views{MakeView(camera_, edges_)};
    return Associate(model_, kBoth, views, Eigen::Isometry3d::Identity(), {});
  }

  static constexpr std::array<int, 2> kBoth{0, 1};
  const CameraModel camera_ = test::HeadCamera(0, 1);
  LandmarkModel model_;
  EdgeImage edges_;
};

TEST_F(EdgeAssociationTest, ADecoyOfOppositeContrastIsNotTaken) {
  Draw(0, 0.2, 0, 180, 100);  // nearer
  Draw(0, 0.9, 0, 100, 180);
  const Association unknown = Look();
  ASSERT_EQ(unknown.matches.size(), 1u);
  EXPECT_NEAR(unknown.matches[0].distance_px, 0.2, 0.01);
  model_.edges[0].grey_ratio = std::log(180.0 / 100);
  const Association told = Look();
  ASSERT_EQ(told.matches.size(), 1u);
  EXPECT_NEAR(told.matches[0].distance_px, 0.9, 0.01);
  EXPECT_NEAR(told.matches[0].grey_ratio, std::log(180.0 / 100), 1e-9);
}

TEST_F(EdgeAssociationTest, GreyValuesWeighForAndAgainst) {
  Draw(0, 0, 0, 100, 180);
  const double unknown = Look().log_odds;
  model_.edges[0].grey_ratio = std::log(180.0 / 100);
  const double right = Look().log_odds;
  model_.edges[0].grey_ratio = -std::log(180.0 / 100);
  const double wrong = Look().log_odds;
  EXPECT_GT(right, unknown + 0.5);
  EXPECT_LT(wrong, unknown - 1.5);
  EXPECT_GT(wrong, unknown - 2.5) << "something else may stand before it";
}

TEST_F(EdgeAssociationTest, LightThatChangesBothSidesChangesNothing) {
  model_.edges[0].grey_ratio = std::log(180.0 / 100);
  Draw(0, 0, 0, 100, 180);
  const double bright = Look().log_odds;
  edges_.segments.clear();
  Draw(0, 0, 0, 25, 45);
  EXPECT_NEAR(Look().log_odds, bright, 1e-9);
}

TEST_F(EdgeAssociationTest, EdgesThatEndInTheirCornerSpeakForIt) {
  Draw(0, 0, 3, 100, 180);
  Draw(1, 0, 3, 100, 180);
  const Association ends = Look();
  ASSERT_EQ(ends.corners.size(), 1u);
  EXPECT_GT(ends.corners[0].log_odds, 1);
  edges_.segments.clear();
  // as the edge of something beside it
  Draw(0, 0, 25, 100, 180);
  Draw(1, 0, 3, 100, 180);
  const Association short_of_it = Look();
  ASSERT_EQ(short_of_it.corners.size(), 1u);
  EXPECT_LT(short_of_it.corners[0].log_odds, 0);
  EXPECT_LT(short_of_it.log_odds, ends.log_odds - 2);
}

TEST_F(EdgeAssociationTest, ACornerNeedsBothEdges) {
  Draw(0, 0, 0, 100, 180);
  EXPECT_TRUE(Look().corners.empty());
  edges_.segments.clear();
  Draw(0, 0, 0, 100, 180);
  Draw(1, 0, 0, 100, 180);
  model_.edges[1].side = 3;  // what may stand elsewhere is nobody's neighbour
  EXPECT_TRUE(Look().corners.empty());
}

TEST_F(EdgeAssociationTest, WhatIsSetAsideIsEvidenceAndNotMeasuredBy) {
  Draw(0, 0, 0, 100, 180);
  Draw(1, 0, 0, 100, 180);
  Association dut = Look();
  const double before = dut.log_odds;
  EXPECT_EQ(dut.Measuring(), 2);
  dut.SetAside(1, -1);
  EXPECT_EQ(dut.Measuring(), 1);
  EXPECT_EQ(dut.log_odds, before);
}

TEST_F(EdgeAssociationTest, AnEdgeTakenBackTakesItsCornersAlong) {
  Draw(0, 0, 0, 100, 180);
  const double without = Look().log_odds;
  Draw(1, 0, 0, 100, 180);
  Association dut = Look();
  EXPECT_GT(dut.log_odds, without + 2);
  dut.Withdraw(model_, 1, -1);
  EXPECT_TRUE(dut.corners.empty());
  EXPECT_NEAR(dut.log_odds, without, 1e-9);
}

}  // namespace
}  // namespace priamos::head
