#include "head/core/stand/upright_votes.hpp"

#include <gtest/gtest.h>

#include "test/head/exact_view.hpp"

namespace priamos::head {
namespace {

CameraModel Camera() {
  CameraModel camera;
  camera.image_from_base << 800, 0, 384, 0, 0, 800, 288, 0, 0, 0, 1, 0;
  return camera;
}

TEST(SteepEdges, OnlySteepAndLongOnesVoteTheLongestFirst) {
  test::ExactView picture(Camera());
  picture.Draw({100, 100}, {102, 140});
  picture.Draw({200, 100}, {300, 120});  // level
  picture.Draw({400, 100}, {400, 108});  // short
  picture.Draw({500, 300}, {505, 400});
  const CameraView view = picture.View();
  const auto dut = SteepEdges(std::span(&view, 1), {});
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_GT(dut[0].weight, dut[1].weight);
}

TEST(SteepEdges, AnEdgeOfTheAxisHoldsTheVerticalAndKnowsItAsWellAsItsAngle) {
  test::ExactView picture(Camera(), 0.1);
  picture.Draw({384, 188}, {384, 388});
  const CameraView view = picture.View();
  const auto dut = SteepEdges(std::span(&view, 1), {});
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0].normal.dot(Eigen::Vector3d::UnitY()), 0, 1e-9);
  EXPECT_NEAR(dut[0].Sigma(Eigen::Vector3d::UnitY()), view.edges->segments[0].sigma_angle_rad, 1e-6);
}

}  // namespace
}  // namespace priamos::head
