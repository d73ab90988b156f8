#include "head/core/stereo/space_edge.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>

#include "common/geometry.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;

/// Camera with its optical centre at `centre` [m].
CameraModel MovedTo(CameraModel camera, const Vector3d& centre) {
  camera.image_from_base.col(3) = -camera.image_from_base.leftCols<3>() * centre;
  return camera;
}

/// Left, right, and a third camera above and between them.
class SpaceEdgeTest : public testing::Test {
 protected:
  using Sightings = std::vector<LineSighting>;

  void SeeBoth(const Vector3d& from, const Vector3d& to) { left_.See(from, to), right_.See(from, to); }
  std::optional<SpaceEdge> FromTwo(double camera_sigma_px = 0.1) {
    const CameraView left = left_.View(), right = right_.View();
    return Reconstruct(Sightings{{&left, 0}, {&right, 0}}, camera_sigma_px);
  }
  std::optional<SpaceEdge> FromThree(double camera_sigma_px = 0.1) {
    const CameraView left = left_.View(), right = right_.View(), third = third_.View();
    return Reconstruct(Sightings{{&left, 0}, {&right, 0}, {&third, 0}}, camera_sigma_px);
  }

  test::ExactView left_{test::HeadCamera(0, 1)}, right_{test::HeadCamera(0, -1)},
      third_{MovedTo(test::HeadCamera(0, 0), {0.25, 0, 1.32})};
};

TEST_F(SpaceEdgeTest, AnEdgeThatTwoImagesShowIsWhereItIs) {
  const Vector3d from(3, 0.2, 0.9), to(3.1, 0.1, 1.6);
  SeeBoth(from, to);
  const auto dut = FromTwo();
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->from - from).norm(), 1e-6);
  EXPECT_LT((dut->to - to).norm(), 1e-6);
}

TEST_F(SpaceEdgeTest, ItRunsAsTheFirstImageHasIt) {
  const Vector3d low(3, 0.2, 0.9), high(3, 0.2, 1.6);
  left_.See(high, low);
  right_.See(low, high);
  const auto dut = FromTwo();
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->from - high).norm(), 1e-6);
  EXPECT_LT((dut->to - low).norm(), 1e-6);
}

TEST_F(SpaceEdgeTest, OnlyThePartThatAllImagesShowIsGiven) {
  const auto on_edge = [](double z) { return Vector3d(3, 0.2, z); };
  left_.See(on_edge(0.9), on_edge(1.6));
  right_.See(on_edge(1.1), on_edge(1.8));
  const auto two = FromTwo();
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->from.z(), 1.1, 1e-5);
  EXPECT_NEAR(two->to.z(), 1.6, 1e-5);
  third_.See(on_edge(0.8), on_edge(1.4));
  const auto three = FromThree();
  ASSERT_TRUE(three);
  EXPECT_NEAR(three->from.z(), 1.1, 1e-5);
  EXPECT_NEAR(three->to.z(), 1.4, 1e-5);
}

TEST_F(SpaceEdgeTest, WithoutACommonPartThereIsNoEdge) {
  left_.See({3, 0.2, 0.7}, {3, 0.2, 1.0});
  right_.See({3, 0.2, 1.1}, {3, 0.2, 1.6});
  EXPECT_FALSE(FromTwo());
}

TEST_F(SpaceEdgeTest, LinesOfSightThatMeetBehindTheCamerasAreNoEdge) {
  left_.See({3, 0.5, 0.9}, {3, 0.5, 1.6});
  right_.See({3, -0.5, 0.9}, {3, -0.5, 1.6});
  EXPECT_FALSE(FromTwo());
}

TEST_F(SpaceEdgeTest, OneImageIsNotEnough) {
  left_.See({3, 0.2, 0.9}, {3, 0.2, 1.6});
  const CameraView view = left_.View();
  EXPECT_FALSE(Reconstruct(Sightings{{&view, 0}}, 0.1));
  EXPECT_FALSE(Reconstruct(Sightings{}, 0.1));
}

TEST_F(SpaceEdgeTest, AnEdgeAlongTheBaselineNeedsTheThirdImage) {
  const Vector3d from(3, 0.2, 1.6), to(3, -0.2, 1.6);
  SeeBoth(from, to);
  EXPECT_FALSE(FromTwo());
  third_.See(from, to);
  const auto dut = FromThree();
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->from - from).norm(), 1e-5);
  EXPECT_LT((dut->to - to).norm(), 1e-5);
}

TEST_F(SpaceEdgeTest, NothingIsSaidAboutTheDirectionAlongTheEdge) {
  const Vector3d from(3, 0.2, 0.9), to(3.1, 0.1, 1.6);
  SeeBoth(from, to);
  const auto dut = FromTwo();
  ASSERT_TRUE(dut);
  const Vector3d along = (to - from).normalized();
  const double scale = dut->covariance.trace();
  EXPECT_GT(scale, 0);
  EXPECT_LT((dut->covariance.topLeftCorner<3, 3>() * along).norm(), 1e-6 * scale);
  EXPECT_LT((dut->covariance.bottomRightCorner<3, 3>() * along).norm(), 1e-6 * scale);
  EXPECT_LT((dut->covariance - dut->covariance.transpose()).norm(), 1e-9 * scale);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(dut->covariance);
  EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-9 * scale);
}

TEST_F(SpaceEdgeTest, TheErrorIsThatOfTheDisparity) {
  // Depth z = f b / d of a vertical edge: sigma_z = z^2 / (f b) sigma_d, at the middle of the lines, where
  // both cameras know them to hypot(sigma, camera sigma).
  SeeBoth({3.25, 0, 1.0}, {3.25, 0, 1.4});
  const double z = 3, sigma_d = std::sqrt(2.0) * std::hypot(0.05, 0.12);
  const auto dut = FromTwo(0.12);
  ASSERT_TRUE(dut);
  const Eigen::Matrix3d middle =
      (dut->covariance.topLeftCorner<3, 3>() + dut->covariance.bottomRightCorner<3, 3>() +
       dut->covariance.topRightCorner<3, 3>() + dut->covariance.bottomLeftCorner<3, 3>()) /
      4;
  const double expected = z * z / (1000 * 0.3) * sigma_d;
  EXPECT_NEAR(std::sqrt(middle(0, 0)), expected, 0.02 * expected);
  EXPECT_NEAR(std::sqrt(middle(1, 1)), expected * 0.15 / 3, 0.05 * expected);
}

TEST_F(SpaceEdgeTest, ImagesThatAgreeHaveNoMisfitAndOthersOneThatGrowsWithTheSquare) {
  const Vector3d from(3, 0.2, 0.9), to(3, 0.2, 1.6);
  SeeBoth(from, to);
  double misfit[3];
  for (int px = 0; px < 3; ++px) {
    const Vector2d aside(px, 0);
    test::ExactView third(third_.camera());
    third.Draw(third.camera().Project(from) + aside, third.camera().Project(to) + aside);
    const CameraView left = left_.View(), right = right_.View(), moved = third.View();
    const auto dut = Reconstruct(Sightings{{&left, 0}, {&right, 0}, {&moved, 0}}, 0.1);
    ASSERT_TRUE(dut);
    misfit[px] = dut->chi2;
  }
  EXPECT_LT(misfit[0], 1e-6);
  EXPECT_GT(misfit[1], 10);
  EXPECT_NEAR(misfit[2], 4 * misfit[1], 0.1 * misfit[2]);
}

RC_GTEST_PROP(EpipoleTest, EpipolarLinesPassThroughTheEpipole, ()) {
  const CameraModel in = test::HeadCamera(Between(-0.2, 0.2), 1),
                    of = MovedTo(test::HeadCamera(0, -1), {Between(1, 2), Between(-1, 1), Between(1, 1.5)});
  const Vector3d epipole = Epipole(in, of), centre = OpticalCentre(of);
  RC_ASSERT((epipole.hnormalized() - in.Project(centre)).norm() < 1e-6);
  const Vector3d seen(Between(3, 6), Between(-1, 1), Between(0, 2)), nearer = centre + 0.6 * (seen - centre);
  const Vector3d line = in.Project(seen).homogeneous().cross(in.Project(nearer).homogeneous());
  RC_ASSERT(std::abs(line.dot(epipole)) < 1e-6 * line.norm() * epipole.norm());
}

ViewLine LineThrough(const Vector2d& p, const Vector2d& q) {
  ViewLine line;
  line.p = p;
  line.q = q;
  line.length_px = (q - p).norm();
  line.normal = Vector2d(p.y() - q.y(), q.x() - p.x()) / line.length_px;
  return line;
}

RC_GTEST_PROP(EpipolarAngleTest, IsThatBetweenTheLineAndTheWayToTheEpipole, ()) {
  const double angle = Between(0, kPi / 2), bearing = Between(-kPi, kPi), away = Between(50, 2000);
  const Vector2d middle(Between(0, 768), Between(0, 576));
  const Vector2d along(std::cos(bearing + angle), std::sin(bearing + angle));
  const Vector2d epipole = middle + away * Vector2d(std::cos(bearing), std::sin(bearing));
  const ViewLine line = LineThrough(middle - 20 * along, middle + 20 * along),
                 back = LineThrough(line.q, line.p);
  for (const double scale : {1.0, -0.01}) {
    RC_ASSERT(std::abs(EpipolarAngle(line, scale * epipole.homogeneous()) - angle) < 1e-5);
    RC_ASSERT(std::abs(EpipolarAngle(back, scale * epipole.homogeneous()) - angle) < 1e-5);
  }
}

TEST(EpipolarAngleTest, AnEpipoleMayBeInfinitelyFar) {
  const Vector3d sideways(1, 0, 0);
  EXPECT_NEAR(EpipolarAngle(LineThrough({10, 10}, {50, 10}), sideways), 0, 1e-9);
  EXPECT_NEAR(EpipolarAngle(LineThrough({10, 10}, {50, 50}), sideways), kPi / 4, 1e-9);
  EXPECT_NEAR(EpipolarAngle(LineThrough({10, 10}, {10, 50}), sideways), kPi / 2, 1e-9);
}

RC_GTEST_PROP(MetricDepthTest, IsMetresAlongTheAxisWhateverTheScaleOfTheMatrix, ()) {
  CameraModel camera = test::HeadCamera(0, 0);
  camera.image_from_base *= Between(0.01, 10);
  const double depth = Between(0.1, 9);
  const Vector3d at = OpticalCentre(camera) + Vector3d(depth, Between(-2, 2), Between(-2, 2));
  RC_ASSERT(std::abs(MetricDepth(camera, at) - depth) < 1e-9);
}

}  // namespace
}  // namespace priamos::head
