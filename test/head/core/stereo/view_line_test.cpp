#include "head/core/stereo/view_line.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "test/head/exact_view.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;
using test::ExactView;

constexpr double kTable_px = 0.005;  ///< between the nodes of the table of the lens

Vector2d AnyPixel() {
  return {Between(20, 748), Between(20, 556)};
}

TEST(MakeViewTest, ALineThatTheLensBendsIsStraightAgain) {
  for (const double k1 : {-0.2, -0.05, 0.1}) {
    ExactView scene(test::HeadCamera(0, 1, 1000, k1));
    const Vector2d begin(60, 80), end(700, 140);
    scene.Draw(begin, end);
    const CameraView dut = scene.View();
    ASSERT_EQ(dut.lines.size(), 1u);
    const ViewLine& line = dut.lines[0];
    EXPECT_LT(std::abs(line.normal.dot(begin - line.p)), kTable_px) << k1;
    EXPECT_LT(std::abs(line.normal.dot(end - line.p)), kTable_px) << k1;
    EXPECT_LT((line.p - begin).norm(), 2 * kTable_px) << k1;
    EXPECT_LT((line.q - end).norm(), 2 * kTable_px) << k1;
    EXPECT_NEAR(line.length_px, (end - begin).norm(), 3 * kTable_px);
  }
}

RC_GTEST_PROP(MakeViewTest, PointsAreUndistortedAsTheCameraSays, ()) {
  ExactView scene(test::HeadCamera(0, 1, 1000, Between(-0.3, 0.15)));
  scene.Draw(AnyPixel(), AnyPixel() + Vector2d(0.1, 0));
  const CameraView dut = scene.View();
  RC_ASSERT(dut.points.size() == scene.edges().points.size());
  for (std::size_t i = 0; i < dut.points.size(); ++i)
    RC_ASSERT((dut.points[i] - scene.camera().Undistort(scene.edges().points[i].at)).norm() < kTable_px);
}

RC_GTEST_PROP(MakeViewTest, TheNormalPointsToTheBrightSide, ()) {
  ExactView scene(test::HeadCamera(0.1, -1));
  const Vector2d begin = AnyPixel(), end = AnyPixel();
  RC_PRE((end - begin).norm() > 20);
  scene.Draw(begin, end);
  const ViewLine line = scene.View().lines.at(0);
  const Vector2d direction = (end - begin).normalized();
  RC_ASSERT(std::abs(line.normal.norm() - 1) < 1e-9);
  // With y down the right hand of (dx, dy) is (-dy, dx).
  RC_ASSERT((line.normal - Vector2d(-direction.y(), direction.x())).norm() < 1e-6);
}

RC_GTEST_PROP(MakeViewTest, ThePlaneOfSightHoldsTheEdgeAndTheOpticalCentre, ()) {
  ExactView scene(test::HeadCamera(Between(-0.3, 0.3), 1));
  const CameraModel& camera = scene.camera();
  const Eigen::Matrix3d inverse = camera.image_from_base.leftCols<3>().inverse();
  const Vector2d begin = AnyPixel(), end = AnyPixel();
  RC_PRE((end - begin).norm() > 20);
  scene.Draw(begin, end);
  const ViewLine line = scene.View().lines.at(0);
  const Vector3d centre = OpticalCentre(camera);
  RC_ASSERT(std::abs(line.plane.head<3>().norm() - 1) < 1e-9);
  RC_ASSERT(std::abs(line.plane.dot(centre.homogeneous())) < 1e-6);
  for (const Vector2d& at : {begin, end}) {
    const Vector3d sight = inverse * at.homogeneous(), seen = centre + Between(0.5, 8) * sight;
    RC_ASSERT(std::abs(line.plane.dot(seen.homogeneous())) < 1e-5 * (seen - centre).norm());
  }
  // What is seen on the bright side has a positive distance from the plane.
  const Vector2d beside = (begin + end) / 2 + 5 * line.normal;
  const Vector3d sight = inverse * beside.homogeneous(), bright = centre + sight;
  RC_ASSERT(line.plane.dot(bright.homogeneous()) > 0);
}

TEST(MakeViewTest, TheLineIsLaidThroughThePointsNotTheEnds) {
  ExactView scene(test::HeadCamera(0, 1));
  scene.Draw({100, 100}, {300, 150});
  EdgeSegment& segment = scene.edges().segments[0];
  const Vector2d aside = 0.5 * segment.normal();
  segment.begin += aside;
  segment.end -= aside;
  const CameraView dut = scene.View();
  EXPECT_LT((dut.lines[0].p - Vector2d(100, 100)).norm(), 0.01);
  EXPECT_LT((dut.lines[0].q - Vector2d(300, 150)).norm(), 0.01);
}

TEST(MakeViewTest, TheLineThroughScatteredPointsIsThatOfLeastSquares) {
  ExactView scene(test::HeadCamera(0, 1));
  scene.Draw({100, 200}, {300, 200}, 80, 140, 0);
  const double ys[] = {201, 199, 200, 202, 203};  // at x = 100, 150, ... 300
  for (int i = 0; i < 5; ++i) scene.edges().points.push_back({Vector2d(100 + 50 * i, ys[i]), 0.1});
  scene.edges().segments[0].n_points = 5;
  const ViewLine line = scene.View().lines.at(0);
  // Mean 201 at x = 200; slope = sum (x - 200) (y - 201) / sum (x - 200)^2 = 350 / 25000.
  EXPECT_NEAR(line.p.y(), 201 - 100 * 350.0 / 25000, 1e-6);
  EXPECT_NEAR(line.q.y(), 201 + 100 * 350.0 / 25000, 1e-6);
  EXPECT_NEAR(line.p.x(), 100, 1e-6);
  EXPECT_NEAR(line.q.x(), 300, 1e-6);
}

TEST(MakeViewTest, WithoutPointsTheEndsTell) {
  ExactView scene(test::HeadCamera(0, 1, 1000, -0.1));
  scene.Draw({100, 100}, {300, 150}, 80, 140, 0);
  const ViewLine line = scene.View().lines.at(0);
  EXPECT_LT((line.p - Vector2d(100, 100)).norm(), kTable_px);
  EXPECT_LT((line.q - Vector2d(300, 150)).norm(), kTable_px);
}

TEST(MakeViewTest, LinesStandInTheOrderOfTheSegmentsAndOnceMoreInTheTable) {
  ExactView scene(test::HeadCamera(0, 1));
  scene.Draw({100, 100}, {300, 150}, 80, 140);
  scene.Draw({500, 500}, {450, 200}, 20, 220);
  const CameraView dut = scene.View();
  ASSERT_EQ(dut.lines.size(), 2u);
  EXPECT_EQ(dut.size.width, 768);
  EXPECT_EQ(dut.size.height, 576);
  EXPECT_EQ(dut.edges, &scene.edges());
  EXPECT_DOUBLE_EQ(dut.lines[1].contrast, 200);
  ASSERT_EQ(dut.table.length.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const ViewLine& line = dut.lines[i];
    EXPECT_EQ(line.segment, i);
    EXPECT_FLOAT_EQ(dut.table.px[i], float(line.p.x()));
    EXPECT_FLOAT_EQ(dut.table.py[i], float(line.p.y()));
    EXPECT_FLOAT_EQ(dut.table.qx[i], float(line.q.x()));
    EXPECT_FLOAT_EQ(dut.table.qy[i], float(line.q.y()));
    EXPECT_FLOAT_EQ(dut.table.length[i], float(line.length_px));
  }
}

TEST(MakeViewTest, NoEdgesNoLines) {
  ExactView scene(test::HeadCamera(0, 1));
  const CameraView dut = scene.View();
  EXPECT_TRUE(dut.lines.empty() && dut.points.empty() && dut.table.px.empty());
  EXPECT_NE(dut.camera, nullptr);
}

}  // namespace
}  // namespace priamos::head
