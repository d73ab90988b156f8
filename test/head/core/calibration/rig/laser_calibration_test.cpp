#include "head/core/calibration/rig/laser_calibration.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "common/geometry.hpp"
#include "head/core/camera/head_model.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/stripe_renderer.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// The third camera of the drawing, tilted down.
CameraModel ThirdCamera(double pan_deg, double tilt_deg) {
  HeadSetting setting;
  setting.pan_rad = Radians(pan_deg);
  setting.tilt_rad = Radians(tilt_deg);
  return MakeCameraModel({850, {386, 285}, -0.05, 0, 0.02},
                         HeadGeometry().BaseFromCamera(setting, kThird, 0.02));
}

/// A fan from 0.6 m height that looks down 20 degrees and leans a little.
support::Plane Laser() {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.35, Vector3d::UnitY()) * Eigen::AngleAxisd(0.02, Vector3d::UnitX()))
          .toRotationMatrix();
  return {turn * Vector3d::UnitZ(), Vector3d(0.46, 0, 0.60)};
}

class LaserCalibrationTest : public testing::Test {
 protected:
  support::StripeScene Scene(double tilt_deg, const support::Plane& board) const {
    support::StripeScene scene;
    scene.camera = ThirdCamera(0, tilt_deg);
    scene.laser = Laser();
    scene.board = board;
    return scene;
  }
  StripeView View(const support::StripeScene& scene) {
    return {scene.camera, scene.board, StripeFinder().Find(support::Render(scene, rng_))};
  }
  /// On the floor, on a box 0.15 m high, on a slanted board and on a wall.
  std::vector<support::Plane> Boards() const {
    return {{Vector3d::UnitZ(), 0.0},
            {Vector3d::UnitZ(), Vector3d(0, 0, 0.15)},
            {Vector3d(-0.5, 0.1, 1).normalized(), Vector3d(1.8, 0, 0.1)},
            {-Vector3d::UnitX(), Vector3d(1.75, 0, 0)}};
  }
  std::vector<StripeView> Views() {
    std::vector<StripeView> views;
    for (const support::Plane& board : Boards()) views.push_back(View(Scene(36, board)));
    return views;
  }
  /// Largest distance between both planes where the laser works [m].
  static double Error(const LaserPlane& dut) {
    double worst = 0;
    for (const double y : {-0.6, 0.0, 0.6}) {
      for (const double x : {1.2, 2.1}) {
        const Vector3d at = Laser().projection(Vector3d(x, y, 0.2));
        worst = std::max(worst, std::abs(dut.Plane().signedDistance(at)));
      }
    }
    return worst;
  }

  Rng rng_{8};
};

TEST_F(LaserCalibrationTest, FindsThePlaneOfLight) {
  const auto dut = CalibrateLaserPlane(Views());
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(Error(dut->plane), 0.0002);
  EXPECT_LT(dut->rms_px, 0.08);
  EXPECT_GT(dut->points, 2000);
  EXPECT_EQ(dut->residuals_px.size(), std::size_t(dut->points + dut->outliers));
  EXPECT_EQ(dut->view_rms_px.size(), 4u);
}

TEST_F(LaserCalibrationTest, TwoHeightsAreEnough) {
  const auto all = Views();
  const auto dut = CalibrateLaserPlane(std::vector<StripeView>{all[0], all[1]});
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(Error(dut->plane), 0.0005);
}

TEST_F(LaserCalibrationTest, KnowsHowWellItKnows) {
  // Boards are placed to half a millimetre.
  double squares = 0;
  constexpr int kRuns = 12;
  const auto views = Views();
  for (int run = 0; run < kRuns; ++run) {
    auto wrong = views;
    for (StripeView& view : wrong) view.board.offset() += rng_.Normal(0.0005);
    const auto dut = CalibrateLaserPlane(wrong);
    ASSERT_TRUE(dut) << dut.reason();
    squares += std::pow(Laser().signedDistance(dut->plane.pivot_m) / dut->plane.sigma_shift_m, 2);
  }
  EXPECT_GT(squares / kRuns, 0.2);
  EXPECT_LT(squares / kRuns, 2);
}

TEST_F(LaserCalibrationTest, OtherBrightLinesAreLeftOut) {
  auto views = Views();
  for (StripeView& view : views) {
    for (std::size_t i = 0; i < view.points.size() / 5; ++i) view.points[i].at.y() = 60 + 0.1 * i;
  }
  const auto dut = CalibrateLaserPlane(views);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(Error(dut->plane), 0.0005);
  EXPECT_GT(dut->outliers, 300);
}

TEST_F(LaserCalibrationTest, OneFloorFromAnywhereIsOneLineOfSpace) {
  const support::Plane floor(Vector3d::UnitZ(), 0);
  const std::vector<StripeView> views{View(Scene(30, floor)), View(Scene(38, floor))};
  EXPECT_THAT(CalibrateLaserPlane(views).reason(), HasSubstr("one straight line of space"));
}

TEST_F(LaserCalibrationTest, BoardsThatAreNotWhereTheyAreSaidToBeAreRefused) {
  auto views = Views();
  views[1].board = support::Plane(Vector3d::UnitZ(), Vector3d(0, 0, 0.1));
  views[2].board = support::Plane(Vector3d::UnitZ(), Vector3d(0, 0, 0.4));
  EXPECT_THAT(CalibrateLaserPlane(views).reason(), HasSubstr("of the points lie in one plane"));
}

TEST_F(LaserCalibrationTest, BadNumbersAndImpossibleViewsAreRefused) {
  EXPECT_THAT(CalibrateLaserPlane({}).reason(), HasSubstr("0 points"));
  auto views = Views();
  views[1].camera.image_from_base(0, 0) = std::nan("");
  EXPECT_THAT(CalibrateLaserPlane(views).reason(), HasSubstr("view 2: camera or board"));
  views = Views();
  views[0].points[3].at.y() = std::nan("");
  EXPECT_THAT(CalibrateLaserPlane(views).reason(), HasSubstr("view 1"));
  views = Views();
  views[2].board = support::Plane(Vector3d::UnitX(), Vector3d(-2, 0, 0));
  EXPECT_THAT(CalibrateLaserPlane(views).reason(), HasSubstr("view 3: the board is seen edge-on"));
}

TEST_F(LaserCalibrationTest, TheSamePlaneInTheCamera) {
  const auto dut = CalibrateLaserPlane(Views());
  ASSERT_TRUE(dut) << dut.reason();
  HeadSetting setting;
  setting.pan_rad = 0.2;
  setting.tilt_rad = 0.4;
  const Eigen::Isometry3d base_from_camera = HeadGeometry().BaseFromCamera(setting, kThird, 0.02);
  const Vector3d in_light = dut->plane.Plane().projection(Vector3d(1.7, 0.4, 0.3));
  EXPECT_NEAR(dut->plane.InCamera(base_from_camera).signedDistance(base_from_camera.inverse() * in_light), 0,
              1e-12);
}

}  // namespace
}  // namespace priamos::head
