#include "head/core/landmark/prediction.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const ImageSize kSize{768, 576};

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
