#include "head/core/calibration/resection/camera_parameters.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"
#include "test/support/calibration_scene.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

TEST(CameraParameters, ElevenParametersAndTheMatrixAreTheSame) {
  CameraParameters truth;
  truth.centre_m = {0.3, -0.2, 1.1};
  truth.camera_from_base =
      (Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  truth.focal_u_px = 1010;
  truth.focal_v_px = 990;
  truth.principal_px = {380, 295};
  truth.axes_angle_rad = Radians(89.5);
  const auto dut = ExtractParameters(-7.0 * -truth.Matrix());
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT((dut->centre_m - truth.centre_m).norm(), 1e-9);
  EXPECT_LT((dut->camera_from_base - truth.camera_from_base).norm(), 1e-9);
  EXPECT_NEAR(dut->focal_u_px, 1010, 1e-6);
  EXPECT_NEAR(dut->focal_v_px, 990, 1e-6);
  EXPECT_LT((dut->principal_px - truth.principal_px).norm(), 1e-6);
  EXPECT_NEAR(dut->axes_angle_rad, Radians(89.5), 1e-9);
  EXPECT_LT((dut->Matrix() - truth.Matrix()).norm(), 1e-6);
  EXPECT_LT((dut->OmegaPhiKappa() - Eigen::Vector3d(0.3, -0.2, 1.4)).norm(), 1e-9);
}

TEST(CameraParameters, OfARealViewAreThoseOfItsLens) {
  support::CameraView view;
  view.focal_px = 1234;
  view.azimuth_rad = 0.4;
  const auto dut = ExtractParameters(support::MakeCamera(view).image_from_base);
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->focal_u_px, 1234, 1e-6);
  EXPECT_NEAR(dut->axes_angle_rad, kPi / 2, 1e-9);
  EXPECT_THAT(dut->ToText(), HasSubstr("1234.000"));
}

TEST(CameraParameters, RefusesWhatIsNoCamera) {
  Eigen::Matrix<double, 3, 4> m = Eigen::Matrix<double, 3, 4>::Zero();
  EXPECT_THAT(ExtractParameters(m).reason(), HasSubstr("infinity"));
  m = support::MakeCamera({}).image_from_base;
  m.row(0).swap(m.row(1));
  EXPECT_THAT(ExtractParameters(m).reason(), HasSubstr("mirrors"));
}

}  // namespace
}  // namespace priamos::head
