#include "head/core/calibration/targets/calibration_quality.hpp"

#include <gtest/gtest.h>

#include "test/support/calibration_scene.hpp"

namespace priamos::head {
namespace {

class CalibrationQuality : public testing::Test {
 protected:
  std::vector<DiscObservation> Observe(double azimuth_rad, double noise_px) {
    support::CameraView view;
    view.azimuth_rad = azimuth_rad;
    const CameraModel camera = support::MakeCamera(view);
    std::vector<DiscObservation> observations;
    for (const ReferenceDisc& disc : object.discs) {
      const Eigen::Vector2d noise(rng.Normal(noise_px), rng.Normal(noise_px));
      observations.push_back({disc, *ProjectDiscCentroid(camera, disc) + noise, std::max(noise_px, 0.005)});
    }
    return observations;
  }
  Rng rng{2};
  ReferenceObject object = support::ShippedReferenceObject();
};

TEST_F(CalibrationQuality, PredictionErrorsExceedTheErrorOfTheFit) {
  const auto observations = Observe(0, 0.1);
  const auto fit = CalibrateFromDiscs(observations);
  ASSERT_TRUE(fit);
  const PredictionErrors dut = PredictHeldOut(observations);
  EXPECT_EQ(dut.failed, 0);
  EXPECT_GT(dut.leave_one_out_px, fit->mean_error_px);
  EXPECT_LT(dut.leave_one_out_px, 0.4);
  EXPECT_GT(dut.held_out_px, fit->mean_error_px);
}

TEST_F(CalibrationQuality, OneWrongPointShowsInThePrediction) {
  auto observations = Observe(0, 0.01);
  const double clean = PredictHeldOut(observations).leave_one_out_px;
  observations[5].centroid_px.x() += 0.5;
  EXPECT_GT(PredictHeldOut(observations).leave_one_out_px, 3 * clean);
}

TEST_F(CalibrationQuality, TooFewPointsAreCountedAsFailed) {
  auto observations = Observe(0, 0.01);
  observations.resize(6);
  EXPECT_GE(PredictHeldOut(observations).failed, 6);
}

TEST_F(CalibrationQuality, TheObjectIsReconstructedToTenthsOfAMillimetre) {
  std::vector<CameraCalibration> cameras;
  for (const double azimuth : {-0.1, 0.1}) {
    const auto c = CalibrateFromDiscs(Observe(azimuth, 0.01));
    ASSERT_TRUE(c);
    cameras.push_back(*c);
  }
  const auto points = CommonPoints(cameras);
  EXPECT_EQ(points.size(), 16u);
  const ReconstructionErrors dut = Reconstruct(points);
  EXPECT_EQ(dut.points, 16);
  EXPECT_LT(dut.rms_m, 0.0003);
  EXPECT_LE(dut.mean_m, dut.rms_m);
  EXPECT_LE(dut.rms_m, dut.max_m);
}

TEST(Triangulation, FindsThePointThatBothRaysShow) {
  support::CameraView left, right;
  left.azimuth_rad = -0.1;
  right.azimuth_rad = 0.1;
  left.k1 = right.k1 = -0.05;
  const CameraModel a = support::MakeCamera(left), b = support::MakeCamera(right);
  const Eigen::Vector3d point(0.1, 0.05, -0.2);
  const Ray rays[] = {{&a, a.Distort(a.Project(point))}, {&b, b.Distort(b.Project(point))}};
  const auto dut = Triangulate(rays);
  ASSERT_TRUE(dut);
  EXPECT_LT((*dut - point).norm(), 1e-9);
}

TEST(Triangulation, OneCameraHasNoDepth) {
  const CameraModel a = support::MakeCamera({});
  const Ray rays[] = {{&a, {300, 200}}, {&a, {300, 200}}};
  EXPECT_FALSE(Triangulate(std::span(rays).first(1)));
  EXPECT_FALSE(Triangulate(rays));
}

}  // namespace
}  // namespace priamos::head
