#include "head/core/stereo/vertical_stereo.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
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
  empty.width = 768, empty.height = 576;
  EXPECT_TRUE(MatchVerticals(MakeView(left_, left_edges_), MakeView(right_, empty), {}).empty());
}

}  // namespace
}  // namespace priamos::head
