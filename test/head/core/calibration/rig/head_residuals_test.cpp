#include "head/core/calibration/rig/head_residuals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;
using support::GeneratedRng;

/// A head whose every parameter is a little off the drawing.
HeadModel AnyHead(Rng& rng) {
  HeadModel head;
  HeadGeometry& g = head.geometry;
  for (double* length : {&g.x_m, &g.y_m, &g.z_m, &g.tilt_axis_x_m}) *length += rng.Normal(0.02);
  for (double* angle : {&g.roll_rad, &g.pitch_rad, &g.yaw_rad, &g.tilt_axis_roll_rad})
    *angle += rng.Normal(0.02);
  for (int c = 0; c < kCameras; ++c) {
    CameraMount& m = g.cameras[c];
    for (double* length : {&m.x_m, &m.y_m, &m.z_m, &m.side_m}) *length += rng.Normal(0.01);
    for (double* angle : {&m.axis_roll_rad, &m.axis_pitch_rad, &m.roll_rad, &m.pitch_rad, &m.yaw_rad})
      *angle += rng.Normal(0.02);
    const LensState lens{rng.Uniform(800, 1500), {380, 290}, rng.Normal(0.05), rng.Normal(0.02), 0.03};
    head.lenses[c] = LensTable({0}, {0}, {lens});
  }
  return head;
}

/// The numbers as the residual takes them.
std::array<double, kHead> HeadNumbers(const HeadGeometry& g) {
  return {g.x_m, g.y_m, g.z_m, g.roll_rad, g.pitch_rad, g.yaw_rad, g.tilt_axis_x_m, g.tilt_axis_roll_rad};
}
std::array<double, kMount> MountNumbers(const CameraMount& m) {
  return {m.x_m,    m.y_m,      m.z_m,       m.axis_roll_rad, m.axis_pitch_rad,
          m.side_m, m.roll_rad, m.pitch_rad, m.yaw_rad};
}
std::array<double, kLens> LensNumbers(const LensState& l) {
  return {std::log(l.focal_px), l.centre_px.x(), l.centre_px.y(), l.k1, l.k2, l.pupil_m};
}

/// Residual of a camera of the head; nullopt if the point is not before it.
std::optional<Vector2d> ResidualOf(const HeadModel& head, const HeadReprojection& dut,
                                   const std::array<double, kJitter>& jitter = {}) {
  const auto h = HeadNumbers(head.geometry);
  const auto m = MountNumbers(head.geometry.cameras[dut.camera]);
  const auto l = LensNumbers(head.lenses[dut.camera].nodes().front());
  Vector2d residual = Vector2d::Zero();
  if (!dut(h.data(), m.data(), l.data(), jitter.data(), residual.data())) return std::nullopt;
  return residual;
}

HeadSetting AnySetting(Rng& rng) {
  HeadSetting s;
  s.pan_rad = rng.Uniform(-0.3, 0.3);
  s.tilt_rad = rng.Uniform(-0.2, 0.2);
  s.vergence_rad = {rng.Uniform(-0.1, 0.1), rng.Uniform(-0.1, 0.1)};
  return s;
}

/// Before the camera, off its axis.
Vector3d PointBefore(const HeadModel& head, const HeadSetting& setting, int camera, Rng& rng) {
  const double pupil_m = head.lenses[camera].nodes().front().pupil_m;
  return head.geometry.BaseFromCamera(setting, camera, pupil_m) *
         Vector3d(rng.Uniform(-0.5, 0.5), rng.Uniform(-0.4, 0.4), rng.Uniform(1.5, 3));
}

RC_GTEST_PROP(HeadReprojection, SeesPointsWhereTheCalibratedHeadSeesThem, ()) {
  Rng rng = GeneratedRng();
  const HeadModel head = AnyHead(rng);
  const HeadSetting setting = AnySetting(rng);
  for (const int camera : {kLeft, kRight, kThird}) {
    const auto model = head.CameraAt(setting, camera);
    RC_ASSERT(static_cast<bool>(model));
    const Vector3d point = PointBefore(head, setting, camera, rng);
    const Vector2d seen = model->Distort(model->Project(point)), off(rng.Normal(2), rng.Normal(2));
    const auto dut = ResidualOf(head, {setting, camera, point, seen + off, 0.5});
    RC_ASSERT(dut.has_value());
    RC_ASSERT((*dut + off / 0.5).norm() < 1e-6);  // computed minus measured, in sigmas
  }
}

RC_GTEST_PROP(HeadReprojection, ErrorsOfTheMotorsAddToTheSetting, ()) {
  Rng rng = GeneratedRng();
  const HeadModel head = AnyHead(rng);
  const HeadSetting setting = AnySetting(rng);
  const std::array<double, kJitter> jitter{rng.Normal(0.01), rng.Normal(0.01), rng.Normal(0.01),
                                           rng.Normal(0.01)};
  HeadSetting moved = setting;
  moved.pan_rad += jitter[0];
  moved.tilt_rad += jitter[1];
  moved.vergence_rad[0] += jitter[2];
  moved.vergence_rad[1] += jitter[3];
  for (const int camera : {kLeft, kRight, kThird}) {
    const Vector3d point = PointBefore(head, setting, camera, rng);
    const auto dut = ResidualOf(head, {setting, camera, point, {400, 300}, 1}, jitter),
               expected = ResidualOf(head, {moved, camera, point, {400, 300}, 1});
    RC_ASSERT(dut && expected);
    RC_ASSERT((*dut - *expected).norm() < 1e-9);
  }
}

TEST(HeadReprojectionTest, APointBehindTheCameraHasNoImage) {
  Rng rng(1);
  const HeadModel head = AnyHead(rng);
  EXPECT_TRUE(ResidualOf(head, {{}, kLeft, {3, 0, 1.2}, {400, 300}, 1}));
  EXPECT_FALSE(ResidualOf(head, {{}, kLeft, {-3, 0, 1.2}, {400, 300}, 1}));
}

RC_GTEST_PROP(Unturn, TakesBackTurnsAboutRollPitchAndYaw, ()) {
  const std::array<double, 3> angles{Between(-2, 2), Between(-1, 1), Between(-3, 3)};
  const Vector3d p(Between(-1, 1), Between(-1, 1), Between(-1, 1));
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(angles[2], Vector3d::UnitZ()) * Eigen::AngleAxisd(angles[1], Vector3d::UnitY()) *
       Eigen::AngleAxisd(angles[0], Vector3d::UnitX()))
          .toRotationMatrix();
  RC_ASSERT((Unturn(angles.data(), Vector3d(turn * p)) - p).norm() < 1e-12);
}

TEST(Near, CountsDistancesFromTheMeanInSigmas) {
  const Near<3> dut{{1, 2, 3}, {0.5, 1, 2}};
  const double x[3] = {2, 2, -1};
  double residual[3] = {};
  EXPECT_TRUE(dut(x, residual));
  EXPECT_EQ(residual[0], 2);
  EXPECT_EQ(residual[1], 0);
  EXPECT_EQ(residual[2], -2);
}

TEST(Smooth, AStraightLineOverTheNodesCostsNothing) {
  const std::array<double, kLens> before{6, 380, 290, -0.1, 0.02, 0.01}, here{7, 382, 289, -0.05, 0.03, 0.02},
      after{9, 384, 288, 0, 0.04, 0.03};
  std::array<double, kLens - 1> residual{};
  EXPECT_TRUE(Smooth()(before.data(), here.data(), after.data(), residual.data()));
  for (const double r : residual) EXPECT_NEAR(r, 0, 1e-9) << "the focal length may bend";
}

TEST(Smooth, ABendCountsInSigmasOfItsParameter) {
  std::array<double, kLens> before{}, here{}, after{};
  for (int i = 1; i < kLens; ++i) after[i] = 3 * Smooth::kBend[i - 1];
  std::array<double, kLens - 1> residual{};
  Smooth()(before.data(), here.data(), after.data(), residual.data());
  for (const double r : residual) EXPECT_NEAR(r, 3, 1e-12);
  Smooth()(before.data(), after.data(), before.data(), residual.data());
  for (const double r : residual) EXPECT_NEAR(r, -6, 1e-12);
}

}  // namespace
}  // namespace priamos::head
