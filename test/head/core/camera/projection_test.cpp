#include "head/core/camera/projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const ImageSize kSize{768, 576};

TEST(ProjectionTest, ProjectionJacobianAgreesWithDifferences) {
  const CameraModel camera = test::HeadCamera(0.1, 1);
  const Eigen::Vector3d point(3, 0.4, 1.5);
  const auto dut = ProjectionJacobian(camera, point);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(k);
    const Eigen::Vector2d slope = (camera.Project(point + step) - camera.Project(point - step)) / 2e-5;
    EXPECT_LT((slope - dut.col(k)).norm(), 1e-4);
  }
}

TEST(ProjectionTest, CutsEdgesAtTheBorderOfTheImage) {
  const CameraModel camera = test::HeadCamera(0, 1);
  const auto dut = ProjectEdge(camera, kSize, {3, 0, -5}, {3, 0, 9});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(std::min(dut->p.y(), dut->q.y()), 0, 1e-6);
  EXPECT_NEAR(std::max(dut->p.y(), dut->q.y()), 575, 1e-6);
  EXPECT_FALSE(dut->p_is_end || dut->q_is_end);
}

TEST(ProjectionTest, KeepsEndsThatAreInTheImage) {
  const auto dut = ProjectEdge(test::HeadCamera(0, 1), kSize, {3, 0, 1}, {3, 0, 9});
  ASSERT_TRUE(dut);
  EXPECT_TRUE(dut->p_is_end);
  EXPECT_FALSE(dut->q_is_end);
}

TEST(ProjectionTest, EdgesBehindTheCameraAreNotSeen) {
  EXPECT_FALSE(ProjectEdge(test::HeadCamera(0, 1), kSize, {-3, 0, 0}, {-3, 0, 2}));
}

TEST(ProjectionTest, AnEdgeThatBeginsBehindTheCameraIsCut) {
  const auto dut = ProjectEdge(test::HeadCamera(0, 1), kSize, {-5, 0.1, 1.4}, {6, 0.1, 1.4});
  ASSERT_TRUE(dut);
  EXPECT_GT(dut->depth_p, 0);
  EXPECT_GT(dut->depth_q, 0);
}

TEST(ProjectionTest, PointAtInvertsTheProjectionAlongTheEdge) {
  const CameraModel camera = test::HeadCamera(0, -1);
  const Eigen::Vector3d from(2, -0.3, 1), to(4, 0.5, 1.6);
  const auto dut = ProjectEdge(camera, kSize, from, to);
  ASSERT_TRUE(dut);
  for (const double f : {0.1, 0.5, 0.9}) {
    const Eigen::Vector3d point = from + f * (to - from);
    EXPECT_LT((dut->PointAt(camera.Project(point)) - point).norm(), 1e-9);
  }
}

TEST(ProjectionTest, TheOpticalCentreIsWhereAllRowsVanish) {
  const CameraModel camera = test::HeadCamera(0.1, -1);
  EXPECT_LT((camera.image_from_base * OpticalCentre(camera).homogeneous()).norm(), 1e-9);
}

}  // namespace
}  // namespace priamos::head
