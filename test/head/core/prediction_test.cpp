#include "head/core/prediction.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const ImageSize kSize{768, 576};

TEST(PredictionTest, ProjectionJacobianAgreesWithDifferences) {
  const CameraModel camera = test::HeadCamera(0.1, 1);
  const Eigen::Vector3d point(3, 0.4, 1.5);
  const auto dut = ProjectionJacobian(camera, point);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(k);
    const Eigen::Vector2d slope = (camera.Project(point + step) - camera.Project(point - step)) / 2e-5;
    EXPECT_LT((slope - dut.col(k)).norm(), 1e-4);
  }
}

TEST(PredictionTest, PoseJacobianAgreesWithDifferences) {
  const Eigen::Isometry3d pose = Lift({2.5, 0.3, 0.4});
  const Eigen::Vector3d in_landmark(0.1, 0.45, 1.7);
  const auto dut = PoseJacobian(pose, pose * in_landmark);
  for (int k = 3; k < 6; ++k) {
    Eigen::Isometry3d turned = pose;
    turned.linear() =
        Eigen::AngleAxisd(1e-6, Eigen::Vector3d::Unit(k - 3)).toRotationMatrix() * pose.linear();
    const Eigen::Vector3d slope = (turned * in_landmark - pose * in_landmark) / 1e-6;
    EXPECT_LT((slope - dut.col(k)).norm(), 1e-5);
  }
}

TEST(PredictionTest, CutsEdgesAtTheBorderOfTheImage) {
  const CameraModel camera = test::HeadCamera(0, 1);
  const auto dut = ProjectEdge(camera, kSize, {3, 0, -5}, {3, 0, 9});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(std::min(dut->p.y(), dut->q.y()), 0, 1e-6);
  EXPECT_NEAR(std::max(dut->p.y(), dut->q.y()), 575, 1e-6);
  EXPECT_FALSE(dut->p_is_end || dut->q_is_end);
}

TEST(PredictionTest, KeepsEndsThatAreInTheImage) {
  const auto dut = ProjectEdge(test::HeadCamera(0, 1), kSize, {3, 0, 1}, {3, 0, 9});
  ASSERT_TRUE(dut);
  EXPECT_TRUE(dut->p_is_end);
  EXPECT_FALSE(dut->q_is_end);
}

TEST(PredictionTest, EdgesBehindTheCameraAreNotSeen) {
  EXPECT_FALSE(ProjectEdge(test::HeadCamera(0, 1), kSize, {-3, 0, 0}, {-3, 0, 2}));
}

TEST(PredictionTest, AnEdgeThatBeginsBehindTheCameraIsCut) {
  const auto dut = ProjectEdge(test::HeadCamera(0, 1), kSize, {-5, 0.1, 1.4}, {6, 0.1, 1.4});
  ASSERT_TRUE(dut);
  EXPECT_GT(dut->depth_p, 0);
  EXPECT_GT(dut->depth_q, 0);
}

TEST(PredictionTest, PointAtInvertsTheProjectionAlongTheEdge) {
  const CameraModel camera = test::HeadCamera(0, -1);
  const Eigen::Vector3d from(2, -0.3, 1), to(4, 0.5, 1.6);
  const auto dut = ProjectEdge(camera, kSize, from, to);
  ASSERT_TRUE(dut);
  for (const double f : {0.1, 0.5, 0.9}) {
    const Eigen::Vector3d point = from + f * (to - from);
    EXPECT_LT((dut->PointAt(camera.Project(point)) - point).norm(), 1e-9);
  }
}

TEST(PredictionTest, SearchRegionIsTheScatterOfThePose) {
  const CameraModel camera = test::HeadCamera(0.09, 1);
  const LandmarkModel model = test::DoorModel();
  const Pose2 pose{3, 0.1, 0.05};
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.01, 0.01, 0.0004).asDiagonal();
  const auto dut = PredictEdges(model, pose, covariance, camera, kSize);
  ASSERT_GE(dut.size(), 5u);
  const PredictedEdge& edge = dut.front();
  const Eigen::Vector2d middle = (edge.p + edge.q) / 2;
  const Eigen::Vector3d in_landmark = Lift(pose).inverse() * edge.PointAt(middle);
  Rng rng(1);
  double sum = 0;
  constexpr int kN = 4000;
  for (int i = 0; i < kN; ++i) {
    const Pose2 there{pose.x + rng.Normal(0.1), pose.y + rng.Normal(0.1), pose.yaw + rng.Normal(0.02)};
    const double d = edge.normal().dot(camera.Project(Lift(there) * in_landmark) - middle);
    sum += d * d / kN;
  }
  EXPECT_NEAR(std::sqrt(sum), edge.search_px, 0.15 * edge.search_px);
}

TEST(PredictionTest, EdgesOfTheOtherSideAreNotPredicted) {
  const LandmarkModel model = test::DoorModel();
  const Eigen::Matrix3d sure = 1e-6 * Eigen::Matrix3d::Identity();
  // The robot stands behind the wall and looks back at the door.
  const auto dut = PredictEdges(model, {3, 0, kPi}, sure, test::HeadCamera(0, 1), kSize);
  EXPECT_TRUE(dut.empty());
}

}  // namespace
}  // namespace priamos::head
