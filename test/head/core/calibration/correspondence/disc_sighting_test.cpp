#include "head/core/calibration/correspondence/disc_sighting.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "test/support/ellipses.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;

constexpr double kFocal_px = 1000;
const Vector2d kCentre_px(383.5, 287.5);

/// The image of a disc whose place and normal are given in the camera.
Ellipse ImageOf(const Vector3d& at_m, const Vector3d& normal, double radius_m) {
  Eigen::Matrix<double, 3, 4> image_from_camera;
  image_from_camera << kFocal_px, 0, kCentre_px.x(), 0, 0, kFocal_px, kCentre_px.y(), 0, 0, 0, 1, 0;
  return *ProjectDisc(image_from_camera, {at_m, normal, radius_m});
}

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

double NearestNormal(const Sighting& s, const Vector3d& truth) {
  double nearest = kPi;
  for (const Vector3d& normal : s.normals) nearest = std::min(nearest, AngleBetween(normal, truth));
  return nearest;
}

/// A disc somewhere in the image, its normal `tilt_rad` from the line of sight.
struct Disc {
  explicit Disc(double tilt_rad)
      : at_m(Between(-0.5, 0.5), Between(-0.4, 0.4), Between(1.5, 3)), radius_m(Between(0.005, 0.02)) {
    const Vector3d back = -at_m.normalized(), side = back.unitOrthogonal();
    normal = Eigen::AngleAxisd(Between(0, 2 * kPi), back) * (Eigen::AngleAxisd(tilt_rad, side) * back);
  }
  Sighting Seen() const { return SightDisc(ImageOf(at_m, normal, radius_m), kFocal_px, kCentre_px); }

  Vector3d at_m, normal = Vector3d::Zero();
  double radius_m;
};

RC_GTEST_PROP(DiscSighting, TellsDirectionAndDistanceOfADisc, ()) {
  const Disc disc(Between(0, Radians(65)));
  const Sighting dut = disc.Seen();
  RC_ASSERT(std::abs(dut.ray.norm() - 1) < 1e-12);
  RC_ASSERT(AngleBetween(dut.ray, disc.at_m) < 3e-4);
  RC_ASSERT(std::abs(dut.angular_radius * disc.at_m.norm() / disc.radius_m - 1) < 0.01);
}

RC_GTEST_PROP(DiscSighting, OneOfTwoMirroredNormalsIsThatOfATiltedDisc, ()) {
  const Disc disc(Between(Radians(25), Radians(65)));
  const Sighting dut = disc.Seen();
  RC_ASSERT(dut.normals.size() == 2u);
  RC_ASSERT(NearestNormal(dut, disc.normal) < Radians(2));
  const Vector3d mirrored = 2 * dut.ray.dot(disc.normal) * dut.ray - disc.normal;
  RC_ASSERT(NearestNormal(dut, mirrored) < Radians(2));
}

RC_GTEST_PROP(DiscSighting, ARoundDiscMayLeanToAnySide, ()) {
  const Disc disc(Between(0, Radians(20)));
  const Sighting dut = disc.Seen();
  RC_ASSERT(dut.normals.size() == 5u);
  RC_ASSERT(NearestNormal(dut, disc.normal) < Radians(15.5));
}

RC_GTEST_PROP(DiscSighting, NormalsAreUnitVectorsTowardsTheCamera, ()) {
  const Sighting dut = Disc(Between(0, Radians(65))).Seen();
  for (const Vector3d& normal : dut.normals) {
    RC_ASSERT(std::abs(normal.norm() - 1) < 1e-9);
    RC_ASSERT(normal.dot(dut.ray) < 0);
  }
}

TEST(DiscSighting, ADiscInTheMiddleOfTheImageIsAsLargeAsItsMajorAxis) {
  const Sighting dut = SightDisc(support::EllipseAt(kCentre_px, 20, 10, 0.4), kFocal_px, kCentre_px);
  EXPECT_LT((dut.ray - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(dut.angular_radius, 0.02, 1e-12);
  ASSERT_EQ(dut.normals.size(), 2u);
  for (const Vector3d& normal : dut.normals) {
    EXPECT_NEAR(AngleBetween(normal, -Vector3d::UnitZ()), Radians(60), 1e-9);
    // It leans along the minor axis, which lies a quarter of a turn from the major one.
    EXPECT_NEAR(normal.dot(Vector3d(std::cos(0.4), std::sin(0.4), 0)), 0, 1e-9);
  }
}

TEST(DiscSighting, ALineIsADiscSeenFromTheSide) {
  const Sighting dut = SightDisc(support::EllipseAt(kCentre_px, 20, 0, 0), kFocal_px, kCentre_px);
  for (const Vector3d& normal : dut.normals) EXPECT_NEAR(AngleBetween(normal, dut.ray), kPi / 2, 1e-6);
}

RC_GTEST_PROP(NormalAxes, AreRightHandedWithTheNormalFirstAndUpSecond, ()) {
  const Vector3d normal = Vector3d(Between(-1, 1), Between(-1, 1), Between(0.1, 1)).normalized();
  const Vector3d up = Vector3d(Between(-1, 1), Between(0.1, 1), Between(-1, 1)).normalized();
  const Matrix3d dut = NormalAxes(normal, up);
  RC_ASSERT((dut.transpose() * dut - Matrix3d::Identity()).norm() < 1e-9);
  RC_ASSERT(std::abs(dut.determinant() - 1) < 1e-9);
  RC_ASSERT((dut.col(0) - normal).norm() < 1e-12);
  RC_PRE(normal.cross(up).norm() > 0.11);
  RC_ASSERT(dut.col(1).dot(up) > 0);
  RC_ASSERT(std::abs(dut.col(2).dot(up)) < 1e-9);
}

TEST(NormalAxes, ANormalThatPointsUpHasAxesToo) {
  const Matrix3d dut = NormalAxes(Vector3d::UnitZ(), Vector3d::UnitZ());
  EXPECT_LT((dut.transpose() * dut - Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(dut.determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace priamos::head
