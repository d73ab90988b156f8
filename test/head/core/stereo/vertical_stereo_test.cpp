#include "head/core/stereo/vertical_stereo.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

class VerticalStereoTest : public testing::Test {
 protected:
  VerticalStereoTest() {
    Rng rng(1);
    const auto pose = Lift({3.0, 0.1, 0.05});
    EdgeOperator op;
    const auto quads = test::DoorQuads();
    op.Extract(test::RenderQuads(quads, pose, left_, 2, rng), left_edges_);
    op.Extract(test::RenderQuads(quads, pose, right_, 2, rng), right_edges_);
    dut_ = MatchVerticals(MakeView(left_, left_edges_), MakeView(right_, right_edges_), {});
  }

  double NearestTo(const Eigen::Vector2d& in_landmark) const {
    const Eigen::Vector2d there = Pose2{3.0, 0.1, 0.05} * in_landmark;
    double best = 1e9;
    for (const VerticalEdge& edge : dut_) best = std::min(best, (edge.at - there).norm());
    return best;
  }

  const CameraModel left_ = test::HeadCamera(0, 1, 1000, -0.05),
                    right_ = test::HeadCamera(0, -1, 1000, -0.05);
  EdgeImage left_edges_, right_edges_;
  std::vector<VerticalEdge> dut_;
};

TEST_F(VerticalStereoTest, ReconstructsTheJambsToMillimetres) {
  EXPECT_LT(NearestTo({-0.085, 0.51}), 0.003);
  EXPECT_LT(NearestTo({-0.085, -0.51}), 0.003);
  EXPECT_LT(NearestTo({-0.085, 0.45}), 0.003);
  EXPECT_LT(NearestTo({-0.085, -0.45}), 0.003);
}

TEST_F(VerticalStereoTest, CovarianceGrowsAlongTheLineOfSight) {
  for (const VerticalEdge& edge : dut_) {
    const Eigen::Vector2d ahead = edge.at.normalized(), across(-ahead.y(), ahead.x());
    EXPECT_GT(ahead.dot(edge.covariance * ahead), across.dot(edge.covariance * across));
  }
}

TEST_F(VerticalStereoTest, SwappedImagesGiveNoDoor) {
  const auto swapped = MatchVerticals(MakeView(left_, right_edges_), MakeView(right_, left_edges_), {});
  const Eigen::Vector2d there = Pose2{3.0, 0.1, 0.05} * Eigen::Vector2d(-0.085, 0.51);
  for (const VerticalEdge& edge : swapped) EXPECT_GT((edge.at - there).norm(), 0.1);
}

TEST_F(VerticalStereoTest, NothingSeenNothingFound) {
  EdgeImage empty;
  empty.width = 768;
  empty.height = 576;
  EXPECT_TRUE(MatchVerticals(MakeView(left_, left_edges_), MakeView(right_, empty), {}).empty());
}

/// Single edges without pixels.
class MatchVerticalsTest : public testing::Test {
 protected:
  using Vector3 = Eigen::Vector3d;

  void SeeBoth(const Vector3& from, const Vector3& to) { left_.See(from, to), right_.See(from, to); }
  std::vector<VerticalEdge> Match(const VerticalStereoOptions& options = {}) {
    return MatchVerticals(left_.View(), right_.View(), options);
  }
  test::ExactView left_{test::HeadCamera(0.1, 1)}, right_{test::HeadCamera(0.1, -1)};
};

TEST_F(MatchVerticalsTest, AnEdgeOfBothImagesIsWhereItStands) {
  SeeBoth({3, 0.4, 0.9}, {3, 0.4, 1.5});
  const auto dut = Match();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_LT((dut[0].at - Eigen::Vector2d(3, 0.4)).norm(), 1e-6);
  EXPECT_NEAR(dut[0].z_min_m, 0.9, 1e-6);
  EXPECT_NEAR(dut[0].z_max_m, 1.5, 1e-6);
  EXPECT_EQ(dut[0].left, 0);
  EXPECT_EQ(dut[0].right, 0);
}

TEST_F(MatchVerticalsTest, OnlyTheHeightThatBothSeeIsTold) {
  left_.See({3, 0.4, 0.9}, {3, 0.4, 1.5});
  right_.See({3, 0.4, 1.2}, {3, 0.4, 1.7});
  const auto dut = Match();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0].z_min_m, 1.2, 1e-6);
  EXPECT_NEAR(dut[0].z_max_m, 1.5, 1e-6);
  EXPECT_TRUE(Match({.min_overlap = 0.61}).empty()) << "0.3 of 0.5 m";
  EXPECT_FALSE(Match({.min_overlap = 0.59}).empty());
}

TEST_F(MatchVerticalsTest, RangeHasBounds) {
  SeeBoth({3, 0.4, 0.9}, {3, 0.4, 1.5});
  const double range = std::hypot(3, 0.4);  // from the origin of base
  EXPECT_EQ(Match({.max_range_m = range + 0.01}).size(), 1u);
  EXPECT_TRUE(Match({.max_range_m = range - 0.01}).empty());
  EXPECT_EQ(Match({.min_range_m = range - 0.01}).size(), 1u);
  EXPECT_TRUE(Match({.min_range_m = range + 0.01}).empty());
}

TEST_F(MatchVerticalsTest, LeaningEdgesAreNotUpright) {
  SeeBoth({3, 0.4, 0.9}, {3, 0.4 + 0.6 * std::tan(0.06), 1.5});
  EXPECT_TRUE(Match().empty());
  EXPECT_FALSE(Match({.max_lean_rad = 0.07}).empty());
}

TEST_F(MatchVerticalsTest, ContrastMustAgreeInSignAndSize) {
  left_.See({3, 0.4, 0.9}, {3, 0.4, 1.5}, 80, 140);
  right_.See({3, 0.4, 1.5}, {3, 0.4, 0.9}, 80, 140);
  EXPECT_TRUE(Match().empty()) << "bright on the other side";
  right_.edges().segments.clear();
  right_.edges().points.clear();
  right_.See({3, 0.4, 0.9}, {3, 0.4, 1.5}, 80, 80 + 60 / 3.1);
  EXPECT_TRUE(Match().empty()) << "3.1 times weaker";
  EXPECT_FALSE(Match({.max_contrast_ratio = 3.2}).empty());
}

TEST_F(MatchVerticalsTest, TheCovarianceIsThatOfTriangulation) {
  SeeBoth({3.25, 0, 1.0}, {3.25, 0, 1.4});
  left_.edges().segments[0].sigma_normal_px = right_.edges().segments[0].sigma_normal_px = 0.3;
  const auto one = Match({.camera_sigma_px = 0.4});  // 0.5 px together
  ASSERT_EQ(one.size(), 1u);
  // Two lines of sight that cross at 2 atan(0.15 / 3); each is known to 0.5 px / f times its length.
  const double half = std::atan(0.15 / 3), across = 0.5 / 1000 * 3.0;
  EXPECT_NEAR(std::sqrt(one[0].covariance(0, 0)), across / std::sin(half) / std::sqrt(2.0),
              0.1 * across / std::sin(half));
  EXPECT_NEAR(std::sqrt(one[0].covariance(1, 1)), across / std::cos(half) / std::sqrt(2.0), 0.1 * across);
}

TEST_F(MatchVerticalsTest, AllPairsThatCouldBeAreGiven) {
  SeeBoth({3, 0.4, 0.9}, {3, 0.4, 1.5});
  SeeBoth({3, 0.3, 0.9}, {3, 0.3, 1.5});
  const auto dut = Match();
  EXPECT_EQ(dut.size(), 4u);
  for (const VerticalEdge& edge : dut) {
    EXPECT_EQ((edge.at - Eigen::Vector2d(3, edge.left == 0 ? 0.4 : 0.3)).norm() < 1e-6,
              edge.left == edge.right);
  }
}

}  // namespace
}  // namespace priamos::head
