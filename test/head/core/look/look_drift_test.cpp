#include "head/core/look/look_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "head/core/drift/epipolar_shift.hpp"
#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Pose2 kTruth{3.2, 0.05, 0.02};

/// A door as both cameras see it, and posts of all lengths beside it, without pixels.
class LookDriftTest : public testing::Test {
 protected:
  /// Draws both images; the right one as a camera sees it that has turned about its x and moved its image
  /// down.
  void Draw(double right_down_px, int posts) {
    for (test::ExactView* scene : {&left_, &right_}) {
      const Vector2d shift(0, scene == &right_ ? right_down_px : 0);
      DrawDoor(*scene, shift);
      for (int i = 0; i < posts; ++i) {
        const Vector3d foot(3 + 0.1 * (i % 5), -0.8 + 0.14 * i, 0.8), height(0, 0, 0.35 + 0.04 * i);
        scene->Draw(scene->camera().Project(foot) + shift, scene->camera().Project(foot + height) + shift);
      }
      scene->edges().mean_grey = 100;
    }
  }
  /// The visible edges of the door, matched. In the right image each of them is cut elsewhere, so that their
  /// ends tell nothing.
  void DrawDoor(test::ExactView& scene, const Vector2d& shift) {
    const bool is_right = &scene == &right_;
    for (int e = 0; e < int(model_.edges.size()); ++e) {
      const LandmarkEdge& edge = model_.edges[e];
      const auto seen =
          ProjectEdge(scene.camera(), {768, 576}, Lift(kTruth) * edge.from, Lift(kTruth) * edge.to);
      if (!seen || !edge.IsSeenFrom(kTruth.Inverse().translation())) continue;
      const Vector2d cut = is_right ? Vector2d(0.04 * (e + 1) * (seen->q - seen->p)) : Vector2d(0, 0);
      EdgeMatch match;
      match.edge = e;
      match.camera = is_right;
      match.lines = {scene.Draw(seen->p + cut + shift, seen->q - cut + shift)};
      fix_.matches.push_back(match);
    }
  }
  std::optional<StereoDrift> Measure(Verdict verdict) {
    fix_.verdict = verdict;
    fix_.base_from_landmark = kTruth;
    const StereoViews views{left_.View(), right_.View()};
    return MeasureLookDrift(model_, fix_, views, MatchBinocular(views[0], views[1], {}), {});
  }

  const LandmarkModel model_ = test::DoorModel();
  test::ExactView left_{test::HeadCamera(0, 1)}, right_{test::HeadCamera(0, -1)};
  LandmarkFix fix_;
};

double Sigma(const StereoDrift& drift, int axis) {
  return std::sqrt(drift.covariance(axis, axis));
}

TEST_F(LookDriftTest, CamerasThatStandAsCalibratedHaveNotTurned) {
  Draw(0, 12);
  const auto dut = Measure(Verdict::kFound);
  ASSERT_TRUE(dut);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(dut->turn_rad[axis]), 0.2 * Sigma(*dut, axis));
}

TEST_F(LookDriftTest, ATurnUpIsMeasuredWithAndWithoutALandmark) {
  Draw(1.5, 12);  // the image moved down: about x by 1.5 px / 1000 px
  for (const Verdict verdict : {Verdict::kFound, Verdict::kResidualTooLarge, Verdict::kNotVisible}) {
    const auto dut = Measure(verdict);
    ASSERT_TRUE(dut) << Describe(verdict);
    EXPECT_NEAR(dut->turn_rad.x(), 1.5e-3, 0.3e-3) << Describe(verdict);
    EXPECT_LT(Sigma(*dut, 0), 1e-3) << Describe(verdict);
  }
}

TEST_F(LookDriftTest, OnlyALandmarkTellsHowFarItTurnedSideways) {
  Draw(0, 12);
  const auto with = Measure(Verdict::kFound), without = Measure(Verdict::kTooFewEdges);
  ASSERT_TRUE(with && without);
  EXPECT_LT(Sigma(*with, 1), 1e-3);
  EXPECT_NEAR(Sigma(*without, 1), Sigma(UnknownDrift(), 1), 0.1 * Sigma(UnknownDrift(), 1));
}

TEST_F(LookDriftTest, TooFewEndsLeaveWhatTheLandmarkSays) {
  Draw(0, 0);
  const auto dut = Measure(Verdict::kFound);
  ASSERT_TRUE(dut);
  EXPECT_LT(Sigma(*dut, 1), 1e-3);
}

TEST_F(LookDriftTest, NeitherLandmarkNorEndsSayNothing) {
  Draw(0, 0);
  EXPECT_FALSE(Measure(Verdict::kTooFewEdges));
}

TEST_F(LookDriftTest, ABlindImageSaysNothing) {
  Draw(0, 12);
  for (test::ExactView* scene : {&left_, &right_}) {
    scene->edges().mean_grey = 1;  // black
    EXPECT_FALSE(Measure(Verdict::kFound));
    scene->edges().mean_grey = 100;
    EXPECT_TRUE(Measure(Verdict::kFound));
  }
}

}  // namespace
}  // namespace priamos::head
