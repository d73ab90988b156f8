#include "head/core/calibration/targets/dot_target.hpp"

#include <gmock/gmock.h>

#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

const DotTarget kTarget{6, 5, 0.03, 0.01, true};

/// The dots of the target in the plane x = 0 of the scene's frame, rows along y.
std::vector<ReferenceDisc> Dots() {
  std::vector<ReferenceDisc> dots;
  for (int r = 0; r < kTarget.rows; ++r) {
    for (int c = 0; c < kTarget.columns; ++c)
      dots.push_back(
          {{0, (c - 2.5) * kTarget.spacing_m, (r - 2) * kTarget.spacing_m}, {1, 0, 0}, kTarget.radius_m});
  }
  return dots;
}

support::CameraView View(double azimuth, double elevation, double roll) {
  support::CameraView view;
  view.focal_px = 900;
  view.distance_m = 0.4;
  view.azimuth_rad = azimuth;
  view.elevation_rad = elevation;
  view.roll_rad = roll;
  view.target_m = {0, 0, 0};
  view.centre_px = {390, 280};
  view.k1 = -0.08;
  return view;
}

GreyImage Photograph(const support::CameraView& view, Rng& rng) {
  support::DiscRenderer scene(768, 576, 200, 2);
  const CameraModel camera = support::MakeCamera(view);
  for (const ReferenceDisc& dot : Dots()) scene.AddDisc(camera, dot, -150);
  return scene.Expose({0.7, 2}, rng);
}

const std::vector<support::CameraView> kViews{View(0.4, 0.1, 0), View(-0.4, 0.2, 0.1), View(0.1, 0.5, -0.1),
                                              View(0.1, -0.4, 0.2)};

class DotTargetTest : public testing::Test {
 protected:
  std::vector<std::vector<DiscObservation>> Found() {
    std::vector<std::vector<DiscObservation>> found;
    for (const support::CameraView& view : kViews) {
      const auto dots = FindDots(Photograph(view, rng_), kTarget);
      EXPECT_TRUE(dots) << dots.reason();
      if (dots) found.push_back(*dots);
    }
    return found;
  }
  Rng rng_{3};
  LensKnowledge lens_ = [] {
    LensKnowledge lens;
    lens.centre_sigma_px = 50;
    return lens;
  }();
};

TEST_F(DotTargetTest, FindsEveryDot) {
  for (const auto& dots : Found()) EXPECT_EQ(dots.size(), 30u);
}

TEST_F(DotTargetTest, PhotographsAtDifferentSlantsGiveTheLens) {
  const auto dut = CalibrateFromPlanes(Found(), 768, 576, lens_);
  ASSERT_TRUE(dut) << dut.reason();
  for (const CameraCalibration& view : *dut) EXPECT_LT(view.mean_error_px, 0.02);
  const CameraModel& model = dut->front().model;
  EXPECT_NEAR(model.scale_px, 900, 1);
  EXPECT_NEAR(model.centre_px.x(), 390, 1);
  EXPECT_NEAR(model.centre_px.y(), 280, 1);
  EXPECT_NEAR(model.k1, -0.08, 0.01);
}

TEST_F(DotTargetTest, TheLensHoldsForAPhotographThatTookNoPart) {
  auto views = Found();
  const auto last = views.back();
  views.pop_back();
  const auto dut = CalibrateFromPlanes(views, 768, 576, lens_);
  ASSERT_TRUE(dut) << dut.reason();
  const auto error = ErrorWithLens(last, dut->front().model);
  ASSERT_TRUE(error) << error.reason();
  EXPECT_LT(*error, 0.05);
}

TEST_F(DotTargetTest, RefusesWhatDoesNotDetermineTheLens) {
  auto views = Found();
  views.resize(2);
  EXPECT_THAT(CalibrateFromPlanes(views, 768, 576, lens_).reason(), HasSubstr("2 photographs"));
}

TEST_F(DotTargetTest, RefusesAPhotographWithoutTheGrid) {
  EXPECT_THAT(FindDots(support::DiscRenderer(768, 576, 200, 1).Expose({}, rng_), kTarget).reason(),
              HasSubstr("no grid of 6 by 5"));
  DotTarget larger = kTarget;
  larger.columns = 8;
  EXPECT_FALSE(FindDots(Photograph(kViews[0], rng_), larger));
}

}  // namespace
}  // namespace priamos::head
