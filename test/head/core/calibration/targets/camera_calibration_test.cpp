#include "head/core/calibration/targets/camera_calibration.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

std::vector<DiscObservation> Observe(const ReferenceObject& object, const CameraModel& camera,
                                     double noise_px, Rng& rng) {
  std::vector<DiscObservation> observations;
  for (const ReferenceDisc& disc : object.discs) {
    const Eigen::Vector2d noise(rng.Normal(noise_px), rng.Normal(noise_px));
    observations.push_back({disc, *ProjectDiscCentroid(camera, disc) + noise, std::max(0.005, noise_px)});
  }
  return observations;
}

/// Largest image error over a box around the object [px].
double WorstError(const CameraModel& dut, const CameraModel& truth) {
  double worst = 0;
  for (double x = 0; x <= 0.25; x += 0.125) {
    for (double y = -0.25; y <= 0.25; y += 0.125) {
      for (double z = -0.3; z <= 0.3; z += 0.15) {
        const Eigen::Vector3d p(x, y, z);
        worst = std::max(worst, (dut.Distort(dut.Project(p)) - truth.Distort(truth.Project(p))).norm());
      }
    }
  }
  return worst;
}

class CameraCalibrationTest : public testing::Test {
 protected:
  CameraCalibrationTest() {
    view.k1 = -0.05;
    view.k2 = 0.005;
    view.centre_px = {390, 281};
    view.azimuth_rad = 0.3;
    camera = support::MakeCamera(view);
  }
  Rng rng{9};
  ReferenceObject object = support::ShippedReferenceObject();
  support::CameraView view;
  CameraModel camera;
};

TEST_F(CameraCalibrationTest, PerfectCentroidsGiveThePerfectImage) {
  const auto dut = CalibrateFromDiscs(Observe(object, camera, 0, rng));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(dut->mean_error_px, 0.002);
  EXPECT_LT(WorstError(dut->model, camera), 0.01);
}

TEST_F(CameraCalibrationTest, TheSecondPassRemovesTheBiasOfTheCentroids) {
  // Centres as if there were no bias, and centroids as they are: both must end at the same camera.
  view.distance_m = 1;
  view.azimuth_rad = 0.6;
  view.k1 = view.k2 = 0;
  camera = support::MakeCamera(view);
  double largest_bias = 0;
  for (const ReferenceDisc& disc : object.discs) {
    largest_bias = std::max(largest_bias, CentroidBias(camera, disc).norm());
  }
  EXPECT_GT(largest_bias, 0.1);
  const auto dut = CalibrateFromDiscs(Observe(object, camera, 0, rng));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(WorstError(dut->model, camera), 0.005);
}

TEST_F(CameraCalibrationTest, NoiseStaysSmallInTheWholeVolume) {
  const auto dut = CalibrateFromDiscs(Observe(object, camera, 0.01, rng));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(dut->mean_error_px, 0.015);
  EXPECT_LT(WorstError(dut->model, camera), 0.05);
}

TEST_F(CameraCalibrationTest, PlainDltErrorShowsTheDistortionThatRefinementRemoves) {
  view.focal_px = 800;
  view.k1 = -0.1;
  view.distance_m = 1.1;
  camera = support::MakeCamera(view);
  const auto dut = CalibrateFromDiscs(Observe(object, camera, 0.01, rng));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_GT(dut->dlt_error_px, 5 * dut->mean_error_px);
}

TEST_F(CameraCalibrationTest, FromAnImageInTheBaseFrame) {
  support::DiscRenderer scene(768, 576, 25, 2);
  for (const ReferenceDisc& disc : object.discs) scene.AddDisc(camera, disc, 180);
  const GreyImage image = scene.Expose({}, rng);
  const Eigen::Isometry3d base_from_object =
      Eigen::Translation3d(1.75, 0.1, 1.2) * Eigen::AngleAxisd(3.1, Eigen::Vector3d::UnitZ());
  const auto dut = CalibrateCamera(image, object, DiscLabeller(object), base_from_object);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->discs, 16);
  EXPECT_LT(dut->mean_error_px, 0.02);
  CameraModel in_object = dut->model;
  in_object.image_from_base = dut->model.image_from_base * base_from_object.matrix();
  EXPECT_LT(WorstError(in_object, camera), 0.05);
}

TEST_F(CameraCalibrationTest, AnImageWithoutTheObjectIsRefused) {
  const GreyImage image = support::DiscRenderer(768, 576, 25, 1).Expose({}, rng);
  const auto dut = CalibrateCamera(image, object, DiscLabeller(object), Eigen::Isometry3d::Identity());
  EXPECT_THAT(dut.reason(), HasSubstr("disc-like spots"));
}

TEST_F(CameraCalibrationTest, AWrongObjectIsRefused) {
  auto observations = Observe(object, camera, 0.01, rng);
  for (std::size_t i = 0; i < 16; i += 2) std::swap(observations[i].disc, observations[i + 1].disc);
  EXPECT_FALSE(CalibrateFromDiscs(observations));
}

TEST_F(CameraCalibrationTest, AFlatObjectIsRefused) {
  for (ReferenceDisc& disc : object.discs) disc.centre_m.x() = 0;
  EXPECT_THAT(CalibrateFromDiscs(Observe(object, camera, 0.01, rng)).reason(), HasSubstr("one plane"));
}

}  // namespace
}  // namespace priamos::head
