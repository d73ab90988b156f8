#include "head/core/calibration/correspondence/correspondence.hpp"

#include <gmock/gmock.h>

#include "head/core/calibration/discs/disc_detection.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::head {
namespace {

using support::Sightings;
using testing::HasSubstr;

class Correspondence : public testing::Test {
 protected:
  int Wrong(const Labelling& labelling, const Sightings& s) const {
    int wrong = 0;
    for (const DiscLabel& label : labelling.labels) wrong += s.truth[label.detection] != label.disc;
    return wrong;
  }

  Rng rng{17};
  ReferenceObject object = support::ShippedReferenceObject();
};

TEST_F(Correspondence, EveryVisibleDiscIsNamedInRandomViewsWithClutterAndHiddenDiscs) {
  const DiscLabeller dut(object);
  int complete = 0, refused = 0;
  constexpr int kViews = 500;
  for (int i = 0; i < kViews; ++i) {
    const CameraModel camera = support::MakeCamera(support::RandomView(rng));
    const Sightings s =
        support::Sight(object, camera, static_cast<int>(rng.Below(7)), static_cast<int>(rng.Below(12)), rng);
    const auto found = dut.Label(s.detections);
    if (!found) {
      ++refused;
      continue;
    }
    EXPECT_EQ(Wrong(*found, s), 0) << "view " << i;
    complete += static_cast<int>(found->labels.size()) == s.visible;
  }
  EXPECT_GE(complete, kViews - 1);
  EXPECT_LE(refused, 1);
}

TEST_F(Correspondence, WorksOnImagesOfAnyGain) {
  const DiscLabeller dut(object);
  for (int i = 0; i < 8; ++i) {
    const CameraModel camera = support::MakeCamera(support::RandomView(rng));
    support::DiscRenderer scene(768, 576, rng.Uniform(10, 50), 1);
    const double amplitude = rng.Uniform(60, 190);
    int visible = 0;
    for (const ReferenceDisc& disc : object.discs) {
      if (!support::Unhidden(object, disc, support::EyeOf(camera))) continue;
      scene.AddDisc(camera, disc, amplitude);
      ++visible;
    }
    const auto detections = DetectDiscs(scene.Expose({}, rng));
    const auto found = dut.Label(detections);
    ASSERT_TRUE(found) << found.reason();
    EXPECT_EQ(static_cast<int>(found->labels.size()), visible);
    for (const DiscLabel& label : found->labels) {
      const auto centroid = ProjectDiscCentroid(camera, object.discs[label.disc]);
      EXPECT_LT((detections[label.detection].ellipse.centre_px - *centroid).norm(), 0.2);
    }
  }
}

TEST_F(Correspondence, TellsTheFocalLengthRoughly) {
  support::CameraView view;
  view.focal_px = 1400;
  view.distance_m = 2;
  const Sightings s = support::Sight(object, support::MakeCamera(view), 0, 0, rng);
  const auto found = DiscLabeller(object).Label(s.detections);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->view.focal_px, 1400, 70);
}

TEST_F(Correspondence, TooManyHiddenDiscsAreRefused) {
  const Sightings s = support::Sight(object, support::MakeCamera({}), 8, 0, rng);
  EXPECT_THAT(DiscLabeller(object).Label(s.detections).reason(), HasSubstr("only 8 disc-like spots"));
}

TEST_F(Correspondence, BrightSpotsAloneAreNoObject) {
  const DiscLabeller dut(object);
  for (int i = 0; i < 30; ++i) {
    const Sightings s = support::Sight(object, support::MakeCamera({}), 16, 40, rng);
    const auto found = dut.Label(s.detections);
    EXPECT_FALSE(found);
    EXPECT_THAT(found.reason(), testing::AnyOf(HasSubstr("no arrangement"), HasSubstr("best arrangement")));
  }
}

TEST_F(Correspondence, ASpotBesideAHiddenDiscIsNotTakenForIt) {
  const DiscLabeller dut(object);
  const CameraModel camera = support::MakeCamera({});
  for (int i = 0; i < 50; ++i) {
    Sightings s = support::Sight(object, camera, 0, 0, rng);
    const std::size_t moved = rng.Below(s.detections.size());
    s.detections[moved].ellipse.centre_px += Eigen::Vector2d(rng.Uniform(1, 6), rng.Uniform(-6, 6));
    const auto found = dut.Label(s.detections);
    ASSERT_TRUE(found) << found.reason();
    for (const DiscLabel& label : found->labels) EXPECT_NE(label.detection, static_cast<int>(moved));
    EXPECT_EQ(static_cast<int>(found->labels.size()), s.visible - 1);
  }
}

TEST_F(Correspondence, AnAmbiguousObjectIsRefused) {
  // Two equal halves side by side: shifted by one half, everything but the ends fits again.
  ReferenceObject wallpaper;
  for (int column = 0; column < 12; ++column) {
    for (int row = 0; row < 2; ++row) {
      wallpaper.discs.push_back({{0.05 * row, 0.08 * column - 0.44, 0.1 * row}, {1, 0, 0}, 0.015});
    }
  }
  support::CameraView view;
  view.distance_m = 2.5;
  view.target_m = {0, 0, 0};
  const CameraModel camera = support::MakeCamera(view);
  Sightings s = support::Sight(wallpaper, camera, 0, 0, rng);
  // Both ends hidden: now it could be either.
  Sightings cut;
  for (std::size_t i = 0; i < s.truth.size(); ++i) {
    if (s.truth[i] < 2 || s.truth[i] > 21) continue;
    cut.detections.push_back(s.detections[i]);
  }
  const auto found = DiscLabeller(wallpaper).Label(cut.detections);
  EXPECT_FALSE(found);
}

TEST_F(Correspondence, AnotherObjectWorksToo) {
  ReferenceObject other;
  Rng shape(3);
  for (int i = 0; i < 12; ++i) {
    other.discs.push_back(
        {{shape.Uniform(0, 0.2), shape.Uniform(-0.3, 0.3), 0.07 * i - 0.4},
         Eigen::Vector3d(1, shape.Uniform(-0.2, 0.2), shape.Uniform(-0.2, 0.2)).normalized(),
         shape.Uniform(0.01, 0.03)});
  }
  LabellerOptions options;
  options.max_hidden = 3;
  const DiscLabeller dut(other, options);
  for (int i = 0; i < 40; ++i) {
    support::CameraView view = support::RandomView(rng);
    view.distance_m += 1;
    const Sightings s =
        support::Sight(other, support::MakeCamera(view), static_cast<int>(rng.Below(3)), 5, rng);
    const auto found = dut.Label(s.detections);
    ASSERT_TRUE(found) << found.reason();
    EXPECT_EQ(Wrong(*found, s), 0);
    EXPECT_GE(static_cast<int>(found->labels.size()), s.visible - 1);
  }
}

}  // namespace
}  // namespace priamos::head
