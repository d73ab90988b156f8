#include "head/core/calibration/resection/camera_refinement.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "common/geometry.hpp"
#include "head/core/calibration/resection/camera_parameters.hpp"
#include "test/support/calibration_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::CameraView;
using testing::HasSubstr;

class CameraRefinement : public testing::Test {
 protected:
  static CameraView View(double azimuth_rad) {
    CameraView view;
    view.azimuth_rad = azimuth_rad;
    view.focal_px = 1050;
    view.centre_px = {388, 283};
    view.k1 = -0.06;
    return view;
  }
  std::vector<DiscObservation> Observe(const CameraModel& camera, double noise_px = 0) {
    std::vector<DiscObservation> observations;
    for (const ReferenceDisc& disc : object_.discs) {
      const Vector2d noise(rng_.Normal(noise_px), rng_.Normal(noise_px));
      observations.push_back({disc, camera.Distort(camera.Project(disc.centre_m)) + noise, 0.02});
    }
    return observations;
  }
  /// Camera of a view without distortion, a little elsewhere.
  static CameraModel StartNear(CameraView view) {
    view.k1 = 0;
    view.focal_px *= 1.03;
    view.distance_m *= 1.02;
    view.azimuth_rad += 0.02;
    view.centre_px = {383.5, 287.5};
    return support::MakeCamera(view);
  }
  static double WorstError(const CameraModel& dut, const std::vector<DiscObservation>& observations) {
    double worst = 0;
    for (const DiscObservation& o : observations)
      worst = std::max(worst, (dut.Distort(dut.Project(o.disc.centre_m)) - o.centroid_px).norm());
    return worst;
  }

  const ReferenceObject object_ = support::ShippedReferenceObject();
  const std::vector<Vector2d> none_ = std::vector<Vector2d>(object_.discs.size(), Vector2d::Zero());
  Rng rng_{21};
};

TEST_F(CameraRefinement, FindsPoseAndLensFromPerfectPoints) {
  const auto observations = Observe(support::MakeCamera(View(0.3)));
  const auto dut = RefineCamera(observations, none_, StartNear(View(0.3)), {.centre_sigma_px = 1e3});
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(WorstError(*dut, observations), 0.01);
  const auto parameters = ExtractParameters(dut->image_from_base);
  ASSERT_TRUE(parameters);
  EXPECT_NEAR(parameters->focal_u_px, 1050, 2);
  EXPECT_LT((parameters->centre_m - support::EyeOf(support::MakeCamera(View(0.3)))).norm(), 0.003);
  EXPECT_NEAR(dut->k1, -0.06, 0.01);
}

TEST_F(CameraRefinement, TheModelIsOnePieceWithItsMatrix) {
  const auto dut = RefineCamera(Observe(support::MakeCamera(View(0.3)), 0.1), none_, StartNear(View(0.3)));
  ASSERT_TRUE(dut);
  const auto parameters = ExtractParameters(dut->image_from_base);
  ASSERT_TRUE(parameters);
  EXPECT_NEAR(dut->scale_px, parameters->focal_u_px, 1e-6);
  EXPECT_LT((dut->centre_px - parameters->principal_px).norm(), 1e-6);
  EXPECT_NEAR(dut->image_from_base.row(2).head(3).norm(), 1, 1e-9);
}

TEST_F(CameraRefinement, TheBiasIsTakenOffTheCentroids) {
  auto observations = Observe(support::MakeCamera(View(0.3)));
  std::vector<Vector2d> bias;
  for (DiscObservation& o : observations) {
    bias.emplace_back(rng_.Uniform(-2, 2), rng_.Uniform(-2, 2));
    o.centroid_px += bias.back();
  }
  const auto dut = RefineCamera(observations, bias, StartNear(View(0.3)));
  ASSERT_TRUE(dut) << dut.reason();
  for (std::size_t i = 0; i < bias.size(); ++i) observations[i].centroid_px -= bias[i];
  EXPECT_LT(WorstError(*dut, observations), 0.05);
}

TEST_F(CameraRefinement, WhatIsKnownOfTheLensHoldsItWhereTheViewSaysLittle) {
  const auto observations = Observe(support::MakeCamera(View(0.3)), 0.3);
  const LensKnowledge lens{.centre_px = {390, 280},
                           .centre_sigma_px = 1e-4,
                           .aspect = 1.01,
                           .aspect_sigma = 1e-7,
                           .skew_sigma_rad = 1e-7,
                           .k1_sigma = 1e-6,
                           .k2_sigma = 1e-6};
  const auto dut = RefineCamera(observations, none_, StartNear(View(0.3)), lens);
  ASSERT_TRUE(dut) << dut.reason();
  const auto parameters = ExtractParameters(dut->image_from_base);
  EXPECT_LT((dut->centre_px - Vector2d(390, 280)).norm(), 1e-3);
  EXPECT_NEAR(parameters->focal_v_px / parameters->focal_u_px, 1.01, 1e-4);
  EXPECT_NEAR(parameters->axes_angle_rad, kPi / 2, 1e-5);
  EXPECT_NEAR(dut->k1, 0, 1e-4);
  EXPECT_NEAR(dut->k2, 0, 1e-4);
}

TEST_F(CameraRefinement, PreciseObservationsWeighMore) {
  auto observations = Observe(support::MakeCamera(View(0.3)));
  observations[4].centroid_px += Vector2d(3, 3);
  const auto trusted = RefineCamera(observations, none_, StartNear(View(0.3)));
  observations[4].sigma_px = 20;
  const auto dut = RefineCamera(observations, none_, StartNear(View(0.3)));
  ASSERT_TRUE(trusted && dut);
  observations.erase(observations.begin() + 4);
  EXPECT_LT(WorstError(*dut, observations), 0.1);
  EXPECT_GT(WorstError(*trusted, observations), 0.3);
}

TEST_F(CameraRefinement, AnImageCentreFarOutsideIsReplacedByTheKnownOne) {
  // What a DLT matrix of one noisy view may be: seen from elsewhere with a lens that was shifted.
  CameraModel start = StartNear(View(0.3));
  start.image_from_base.row(0) += 700 * start.image_from_base.row(2);
  const auto observations = Observe(support::MakeCamera(View(0.3)));
  const auto dut = RefineCamera(observations, none_, start);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(WorstError(*dut, observations), 0.1);
}

TEST_F(CameraRefinement, SeveralViewsShareOneLens) {
  std::vector<std::vector<DiscObservation>> observations;
  std::vector<RefinementView> views;
  const std::vector<double> azimuths{-0.4, 0, 0.4};
  for (const double azimuth : azimuths)
    observations.push_back(Observe(support::MakeCamera(View(azimuth)), 0.05));
  for (std::size_t i = 0; i < azimuths.size(); ++i)
    views.push_back({observations[i], none_, StartNear(View(azimuths[i]))});
  const auto dut = RefineViews(views, {.centre_sigma_px = 1e3});
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*dut)[i].k1, (*dut)[0].k1);
    EXPECT_EQ((*dut)[i].scale_px, (*dut)[0].scale_px);
    EXPECT_LT(WorstError((*dut)[i], observations[i]), 0.25) << "five times the noise";
    EXPECT_LT((support::EyeOf((*dut)[i]) - support::EyeOf(support::MakeCamera(View(azimuths[i])))).norm(),
              0.02);
  }
  EXPECT_NEAR((*dut)[0].scale_px, 1050, 8);
}

TEST_F(CameraRefinement, NoViewIsRefused) {
  EXPECT_EQ(RefineViews({}).reason(), "there is no view to refine");
}

TEST_F(CameraRefinement, AStartThatShowsADiscBehindTheCameraIsRefused) {
  auto observations = Observe(support::MakeCamera(View(0.3)));
  observations[2].disc.centre_m = {10, 0, 0};  // the camera stands at about 1.5 m and looks back
  EXPECT_EQ(RefineCamera(observations, none_, StartNear(View(0.3))).reason(),
            "a disc would lie behind the camera");
}

TEST_F(CameraRefinement, NumbersThatAreNotFiniteAreRefused) {
  auto observations = Observe(support::MakeCamera(View(0.3)));
  CameraModel start = StartNear(View(0.3));
  start.image_from_base(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(RefineCamera(observations, none_, start).reason(), HasSubstr("infinity"));
  observations[3].centroid_px.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(RefineCamera(observations, none_, StartNear(View(0.3))).reason(), HasSubstr("refinement"));
}

}  // namespace
}  // namespace priamos::head
