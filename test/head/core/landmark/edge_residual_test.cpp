#include "head/core/landmark/edge_residual.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>

#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;

/// A small motion of space: shift and turn about the origin.
Isometry3d Motion(const Eigen::Matrix<double, 6, 1>& by) {
  Isometry3d motion = Isometry3d::Identity();
  motion.translation() = by.head<3>();
  if (by.tail<3>().norm() > 0)
    motion.linear() = Eigen::AngleAxisd(by.tail<3>().norm(), by.tail<3>().normalized()).toRotationMatrix();
  return motion;
}

/// An edge of any direction before the left camera, and a place in the image beside it.
struct Setup {
  CameraModel camera = test::HeadCamera(0.1, 1);
  Isometry3d pose = Lift({Between(2.5, 4), Between(-0.3, 0.3), Between(-0.3, 0.3)});
  LandmarkEdge edge{.from = {Between(-0.2, 0.2), Between(-0.4, 0.4), Between(0.7, 1.7)}};
  double share = Between(0.1, 0.9), aside_px = 0;

  Setup() { edge.to = edge.from + Vector3d(Between(-0.1, 0.1), Between(-0.3, 0.3), Between(0.2, 0.4)); }
  Vector2d At() const {
    const Vector2d p = camera.Project(pose * edge.from), q = camera.Project(pose * edge.to);
    const Vector2d d = (q - p).normalized();
    return p + share * (q - p) + aside_px * Vector2d(-d.y(), d.x());
  }
  double Distance(const CameraModel& by, const Isometry3d& at, const LandmarkEdge& of) const {
    return ResidualOf(by, at, of, At())->distance_px;
  }
};

constexpr double kStep = 1e-6;

RC_GTEST_PROP(EdgeResidualTest, DistanceIsPositiveToTheRightOfTheEdge, ()) {
  Setup setup;
  setup.aside_px = Between(-5, 5);
  const auto dut = ResidualOf(setup.camera, setup.pose, setup.edge, setup.At());
  RC_ASSERT(dut.has_value());
  RC_ASSERT(std::abs(dut->distance_px - setup.aside_px) < 1e-9);
}

RC_GTEST_PROP(EdgeResidualTest, MovingThePoseMovesTheEdgeAsPromised, ()) {
  const Setup setup;
  const auto dut = ResidualOf(setup.camera, setup.pose, setup.edge, setup.At());
  RC_ASSERT(dut.has_value());
  for (int k = 0; k < 6; ++k) {
    // Turning about the origin of the landmark, with axes parallel to base.
    const Isometry3d motion = Motion(kStep * Eigen::Matrix<double, 6, 1>::Unit(k));
    Isometry3d moved = setup.pose;
    moved.translation() += motion.translation();
    moved.linear() = motion.linear() * setup.pose.linear();
    const double fallen = (dut->distance_px - setup.Distance(setup.camera, moved, setup.edge)) / kStep;
    RC_ASSERT(std::abs(fallen - dut->by_pose(k)) < 1e-2 + 1e-4 * std::abs(fallen));
  }
}

RC_GTEST_PROP(EdgeResidualTest, MovingSpaceAboutTheOriginOfBaseMovesTheEdgeAsPromised, ()) {
  const Setup setup;
  const auto dut = ResidualOf(setup.camera, setup.pose, setup.edge, setup.At());
  RC_ASSERT(dut.has_value());
  for (int k = 0; k < 6; ++k) {
    const Isometry3d moved = Motion(kStep * Eigen::Matrix<double, 6, 1>::Unit(k)) * setup.pose;
    const double fallen = (dut->distance_px - setup.Distance(setup.camera, moved, setup.edge)) / kStep;
    RC_ASSERT(std::abs(fallen - dut->by_base(k)) < 1e-2 + 1e-4 * std::abs(fallen));
  }
}

/// The camera whose image is shifted, rolled and scaled by so many pixels at the lever.
CameraModel Disturbed(CameraModel camera, const Eigen::Vector4d& by) {
  const double roll = by[2] / kCameraLever_px, scale = 1 + by[3] / kCameraLever_px;
  const Eigen::Rotation2Dd turn(roll);
  Eigen::Matrix3d image = Eigen::Matrix3d::Identity();
  image.topLeftCorner<2, 2>() = scale * turn.toRotationMatrix();
  image.topRightCorner<2, 1>() = camera.centre_px - scale * (turn * camera.centre_px) + by.head<2>();
  camera.image_from_base = image * camera.image_from_base;
  return camera;
}

RC_GTEST_PROP(EdgeResidualTest, ErrorsOfTheCameraMoveTheEdgeAsPromised, ()) {
  const Setup setup;
  const auto dut = ResidualOf(setup.camera, setup.pose, setup.edge, setup.At());
  RC_ASSERT(dut.has_value());
  for (int k = 0; k < 4; ++k) {
    const CameraModel other = Disturbed(setup.camera, 1e-4 * Eigen::Vector4d::Unit(k));
    const double fallen = (dut->distance_px - setup.Distance(other, setup.pose, setup.edge)) / 1e-4;
    RC_ASSERT(std::abs(fallen - dut->by_camera[k]) < 1e-3);
  }
}

RC_GTEST_PROP(EdgeResidualTest, AShiftOfTheModelEdgeCountsOnlyAcrossIt, ()) {
  const Setup setup;
  const auto dut = ResidualOf(setup.camera, setup.pose, setup.edge, setup.At());
  RC_ASSERT(dut.has_value());
  const Vector3d along = setup.pose.linear() * (setup.edge.to - setup.edge.from).normalized();
  RC_ASSERT(std::abs(dut->across.dot(along)) < 1e-9 * dut->across.norm());
  for (int k = 0; k < 3; ++k) {
    const Vector3d shift = kStep * (setup.pose.linear().transpose() * Vector3d::Unit(k));
    LandmarkEdge moved = setup.edge;
    moved.from += shift;
    moved.to += shift;
    const double fallen = (dut->distance_px - setup.Distance(setup.camera, setup.pose, moved)) / kStep;
    RC_ASSERT(std::abs(fallen - dut->across[k]) < 1e-2 + 1e-4 * std::abs(fallen));
  }
}

RC_GTEST_PROP(EdgeResidualTest, TheLeverTellsWhereOnTheEdgeOfSpaceItIs, ()) {
  const Setup setup;
  const double lever = Between(-1, 1);
  const Vector3d on_edge =
      (setup.edge.from + setup.edge.to) / 2 + lever / 2 * (setup.edge.to - setup.edge.from);
  const auto dut =
      ResidualOf(setup.camera, setup.pose, setup.edge, setup.camera.Project(setup.pose * on_edge));
  RC_ASSERT(dut.has_value());
  RC_ASSERT(std::abs(dut->lever - lever) < 1e-6);
  RC_ASSERT(std::abs(dut->distance_px) < 1e-6);
}

TEST(EdgeResidualTest, AnEdgeBehindTheCameraHasNone) {
  const CameraModel camera = test::HeadCamera(0, 1);
  const LandmarkEdge edge{.from = {0, 0, 1}, .to = {0, 0, 1.5}};
  EXPECT_TRUE(ResidualOf(camera, Lift({3, 0, 0}), edge, {400, 300}));
  EXPECT_FALSE(ResidualOf(camera, Lift({-3, 0, 0}), edge, {400, 300}));
}

TEST(EdgeResidualTest, AnEdgeSeenEndOnHasNone) {
  const CameraModel camera = test::HeadCamera(0, 0);
  const LandmarkEdge ahead{.from = {0, 0, 1.2}, .to = {0.5, 0, 1.2}};  // along the axis of the camera
  EXPECT_FALSE(ResidualOf(camera, Lift({3, 0, 0}), ahead, {383.5, 290}));
}

TEST(EdgeResidualTest, AnEdgeThatPassesTheCameraIsSeenWhereItIsAhead) {
  const CameraModel camera = test::HeadCamera(0, 0);
  LandmarkEdge edge{.from = {3, 0.5, 0.9}, .to = {-3, 0.5, 0.9}};
  const Vector3d seen(2, 0.5, 0.9);
  for (int way = 0; way < 2; ++way) {
    const auto dut = ResidualOf(camera, Isometry3d::Identity(), edge, camera.Project(seen));
    ASSERT_TRUE(dut);
    EXPECT_NEAR(dut->distance_px, 0, 1e-6);
    EXPECT_NEAR(dut->lever, way == 0 ? -2.0 / 3 : 2.0 / 3, 1e-6);
    std::swap(edge.from, edge.to);
  }
}

std::vector<EdgeObservation> Points(const Vector2d& first, const Vector2d& step, int n, double sigma_px) {
  std::vector<EdgeObservation> points;
  for (int i = 0; i < n; ++i) points.push_back({0, 0, first + i * step, sigma_px});
  return points;
}

RC_GTEST_PROP(ObservedLinesTest, TwoPlacesKnowAsMuchOfTheLineAsAllPoints, ()) {
  const double bearing = Between(-kPi, kPi), sigma = Between(0.05, 0.5);
  const Vector2d along(std::cos(bearing), std::sin(bearing)), first(Between(0, 700), Between(0, 500));
  const auto points = Points(first, 3 * along, *rc::gen::inRange(3, 60), sigma);
  const auto lines = ObservedLines(points);
  RC_ASSERT(lines.size() == 1u && lines[0].n == 2);
  const Vector2d middle = first + 1.5 * (points.size() - 1.0) * along;
  RC_ASSERT(((lines[0].at[0] + lines[0].at[1]) / 2 - middle).norm() < 1e-6);
  double moment = 0;
  for (const EdgeObservation& p : points) moment += (p.at - middle).squaredNorm() / (sigma * sigma);
  double two = 0;
  for (const Vector2d& at : lines[0].at) {
    RC_ASSERT(std::abs(along.x() * (at - first).y() - along.y() * (at - first).x()) < 1e-6);
    two += (at - middle).squaredNorm() / (lines[0].sigma_px * lines[0].sigma_px);
  }
  RC_ASSERT(std::abs(two - moment) < 1e-6 * moment);
  RC_ASSERT(std::abs(2 / (lines[0].sigma_px * lines[0].sigma_px) - points.size() / (sigma * sigma)) <
            1e-6 * two);
}

TEST(ObservedLinesTest, BetterPointsWeighMore) {
  auto points = Points({0, 0}, {100, 0}, 2, 0.1);
  points[1].sigma_px = 0.2;  // a quarter of the weight
  const auto lines = ObservedLines(points);
  EXPECT_NEAR((lines[0].at[0].x() + lines[0].at[1].x()) / 2, 20, 1e-9);
  EXPECT_NEAR(2 / std::pow(lines[0].sigma_px, 2), 100 + 25, 1e-9);
}

TEST(ObservedLinesTest, PointsInOnePlaceKnowNoDirection) {
  const auto lines = ObservedLines(Points({50, 60}, {0.01, 0}, 4, 0.2));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].n, 1);
  EXPECT_LT((lines[0].at[0] - Vector2d(50.015, 60)).norm(), 1e-9);
  EXPECT_NEAR(lines[0].sigma_px, 0.2 / std::sqrt(4.0), 1e-9);
}

TEST(ObservedLinesTest, EveryEdgeInEveryImageIsALineOfItsOwn) {
  std::vector<EdgeObservation> all;
  for (const auto& [edge, camera] : {std::pair(3, 0), std::pair(3, 1), std::pair(5, 1)}) {
    for (EdgeObservation o : Points({10.0 * edge, 20.0 * camera}, {5, 1}, 6, 0.1)) {
      o.edge = edge;
      o.camera = camera;
      all.push_back(o);
    }
  }
  const auto lines = ObservedLines(all);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].edge, 3);
  EXPECT_EQ(lines[0].camera, 0);
  EXPECT_EQ(lines[1].camera, 1);
  EXPECT_EQ(lines[2].edge, 5);
  EXPECT_TRUE(ObservedLines({}).empty());
}

}  // namespace
}  // namespace priamos::head
