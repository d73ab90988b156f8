#include "head/core/look/look_evaluator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const Pose2 kTruth{3.2, 0.05, 0.02};  // base_from_landmark; the landmark is the origin of the map

HeadModel NominalHead() {
  HeadModel head;
  head.lenses.fill(LensTable({650}, {1600}, {LensState{.k1 = -0.05}}));
  return head;
}

HeadSetting Convergent() {
  HeadSetting setting;
  setting.vergence_rad = {-0.02, 0.02};
  setting.zoom_step = {650, 650};
  setting.focus_step = {1600, 1600};
  return setting;
}

/// The door between framed notices: upright edges with ends, which show how the right camera is turned.
std::vector<test::Quad> DoorAndNotices() {
  constexpr double kBeforeWall = -0.075, kWidth = 0.09, kHeight = 0.14;
  std::vector<test::Quad> quads = test::DoorQuads();
  for (const double y : {-1.0, -0.75, 0.75, 1.0})
    for (const double z : {0.9, 1.2, 1.5})
      quads.push_back({{kBeforeWall, y, z}, {0, kWidth, 0}, {0, 0, kHeight}, 60});
  return quads;
}

class LookEvaluatorTest : public testing::Test {
 protected:
  GreyImage Expose(const HeadModel& head, int camera, const std::vector<test::Quad>& quads) {
    const cv::Mat image =
        test::RenderQuads(quads, Lift(kTruth), *head.CameraAt(Convergent(), camera), 3, rng_);
    return {image.cols, image.rows, {image.begin<std::uint8_t>(), image.end<std::uint8_t>()}};
  }

  /// A look at `quads` with a head that is what `head` says; believed 10 cm and 2 degrees wrong.
  LookInput Look(const HeadModel& head, const std::vector<test::Quad>& quads) {
    PoseSample robot;
    robot.map_from_base = Pose2{kTruth.x - 0.1, kTruth.y + 0.1, kTruth.yaw + 0.03}.Inverse();
    robot.covariance = Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();
    return {&model_, robot, {Expose(head, kLeft, quads), Expose(head, kRight, quads)}, Convergent()};
  }

  /// Nothing is found, seen or measured, for this reason.
  void ExpectOnly(Verdict verdict, const LookInput& input) {
    const LookResult dut = dut_.Evaluate(input);
    EXPECT_EQ(dut.fix.verdict, verdict) << Describe(dut.fix.verdict);
    EXPECT_TRUE(dut.view.edges.empty());
    EXPECT_FALSE(dut.drift);
  }

  Rng rng_{7};
  const LandmarkModel model_ = test::DoorModel();
  const HeadModel head_ = NominalHead();
  LookEvaluator dut_{head_, LookOptions()};
};

TEST_F(LookEvaluatorTest, ADoorIsFoundWhereItIsAndTheViewShowsByWhat) {
  const LookResult dut = dut_.Evaluate(Look(head_, test::DoorQuads()));
  ASSERT_EQ(dut.fix.verdict, Verdict::kFound) << Describe(dut.fix.verdict);
  EXPECT_NEAR(dut.fix.base_from_landmark.x, kTruth.x, 0.005);
  EXPECT_NEAR(dut.fix.base_from_landmark.y, kTruth.y, 0.003);
  EXPECT_NEAR(dut.fix.base_from_landmark.yaw, kTruth.yaw, Radians(0.15));
  const auto in_view = std::count_if(dut.view.edges.begin(), dut.view.edges.end(),
                                     [](const auto& edge) { return edge.kind == ViewedEdge::kMatched; });
  const auto of_fix = std::count_if(dut.fix.matches.begin(), dut.fix.matches.end(),
                                    [&](const auto& match) { return match.camera == dut.view.camera; });
  EXPECT_GE(of_fix, 3);
  EXPECT_EQ(in_view, of_fix);
}

TEST_F(LookEvaluatorTest, TheThirdCameraAddsItsEdges) {
  LookInput input = Look(head_, test::DoorQuads());
  const LookResult two = LookEvaluator(head_, LookOptions()).Evaluate(input);
  EXPECT_EQ(two.n_third, 0);
  input.third = Expose(head_, kThird, test::DoorQuads());
  const LookResult dut = dut_.Evaluate(input);
  ASSERT_EQ(dut.fix.verdict, Verdict::kFound) << Describe(dut.fix.verdict);
  EXPECT_GE(dut.n_third, 3);
  EXPECT_GT(dut.fix.log_odds, two.fix.log_odds);
  EXPECT_NEAR(dut.fix.base_from_landmark.y, kTruth.y, 0.003);
  EXPECT_NEAR(dut.fix.base_from_landmark.yaw, kTruth.yaw, Radians(0.15));
  EXPECT_LT(dut.fix.covariance.trace(), 1.001 * two.fix.covariance.trace());
}

TEST_F(LookEvaluatorTest, AThirdPictureThatShowsNothingIsLeftOut) {
  LookInput input = Look(head_, test::DoorQuads());
  input.third = GreyImage{768, 576, std::vector<std::uint8_t>(768 * 576, 0)};
  const LookResult dut = dut_.Evaluate(input);
  EXPECT_EQ(dut.fix.verdict, Verdict::kFound) << Describe(dut.fix.verdict);
  EXPECT_EQ(dut.n_third, 0);
}

TEST_F(LookEvaluatorTest, AThirdPictureOfSomethingElseIsLeftOut) {
  LookInput input = Look(head_, test::DoorQuads());
  const LookResult two = LookEvaluator(head_, LookOptions()).Evaluate(input);
  input.third = Expose(head_, kThird, test::WallQuads());
  EXPECT_NEAR(dut_.Evaluate(input).fix.log_odds, two.fix.log_odds, 1e-6);
}

TEST_F(LookEvaluatorTest, CamerasThatStandAsCalibratedShowNoDrift) {
  const LookResult dut = dut_.Evaluate(Look(head_, DoorAndNotices()));
  ASSERT_TRUE(dut.drift);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LT(std::abs(dut.drift->turn_rad(axis)), 3 * std::sqrt(dut.drift->covariance(axis, axis))) << axis;
}

TEST_F(LookEvaluatorTest, ARightCameraThatLooksHigherThanCalibratedIsMeasured) {
  HeadModel bent = head_;
  bent.geometry.cameras[kRight].pitch_rad -= 0.001;
  const LookResult dut = dut_.Evaluate(Look(bent, DoorAndNotices()));
  ASSERT_TRUE(dut.drift);
  EXPECT_NEAR(dut.drift->turn_rad.x(), 0.001, 0.0003);
}

TEST_F(LookEvaluatorTest, ALookWithoutItsLandmarkMeasuresTheTurnAcrossTheEpipolarLines) {
  HeadModel bent = head_;
  bent.geometry.cameras[kRight].pitch_rad -= 0.001;
  LookInput input = Look(bent, DoorAndNotices());
  const LandmarkModel narrow = test::DoorModel(0.6);
  input.model = &narrow;
  const LookResult dut = dut_.Evaluate(input);
  ASSERT_NE(dut.fix.verdict, Verdict::kFound);
  ASSERT_TRUE(dut.drift);
  EXPECT_NEAR(dut.drift->turn_rad.x(), 0.001, 0.0003);
}

TEST_F(LookEvaluatorTest, TheSettingOfTheMotorsCounts) {
  LookInput input = Look(head_, test::DoorQuads());
  const LookResult straight = dut_.Evaluate(input);
  input.setting.pan_rad += 0.05;
  const LookResult panned = dut_.Evaluate(input);
  ASSERT_EQ(straight.fix.verdict, Verdict::kFound);
  ASSERT_EQ(panned.fix.verdict, Verdict::kFound);
  EXPECT_NEAR(panned.fix.base_from_landmark.yaw - straight.fix.base_from_landmark.yaw, 0.05, 0.002);
}

TEST_F(LookEvaluatorTest, WhatIsMissingIsNamedTheModelFirst) {
  const LookInput complete = Look(head_, test::DoorQuads());
  LookInput input = complete;
  input.setting.zoom_step[kRight] = 700;
  ExpectOnly(Verdict::kNoImage, input);
  input = complete;
  input.images[kRight].reset();
  ExpectOnly(Verdict::kNoImage, input);
  input.robot.reset();
  ExpectOnly(Verdict::kNoPose, input);
  input.model = nullptr;
  ExpectOnly(Verdict::kNoModel, input);
}

TEST_F(LookEvaluatorTest, AnImageOfAFewPixelsIsNone) {
  LookInput input = Look(head_, test::DoorQuads());
  input.images[kLeft] = GreyImage{63, 64, std::vector<std::uint8_t>(63 * 64, 100)};
  ExpectOnly(Verdict::kNoImage, input);
}

TEST_F(LookEvaluatorTest, OneBlackImageMeasuresNothing) {
  LookInput input = Look(head_, test::DoorQuads());
  std::fill(input.images[kRight]->pixels.begin(), input.images[kRight]->pixels.end(), 0);
  const LookResult dut = dut_.Evaluate(input);
  EXPECT_EQ(dut.fix.verdict, Verdict::kNoImage);
  EXPECT_FALSE(dut.drift);
}

TEST_F(LookEvaluatorTest, OfEarlierLooksOnlyWhereEdgesLieAndTheBreadthIsRemembered) {
  const LookInput input = Look(head_, DoorAndNotices());
  const LookResult first = dut_.Evaluate(input);
  dut_.Evaluate(Look(head_, test::WallQuads()));
  const LookResult again = dut_.Evaluate(input);
  ASSERT_EQ(again.fix.verdict, Verdict::kFound);
  EXPECT_NEAR(again.fix.base_from_landmark.x, first.fix.base_from_landmark.x, 2e-4);
  EXPECT_EQ(again.fix.breadth.sigma_m, 0) << "exact by the options";
  EXPECT_EQ(again.view.edges.size(), first.view.edges.size());
  ASSERT_TRUE(first.drift && again.drift);
  EXPECT_LT((again.drift->turn_rad - first.drift->turn_rad).norm(), 1e-4);
}

TEST_F(LookEvaluatorTest, ALookBeyondNeedsAModelAPoseAndPicturesAndSomethingThatIsKnownThere) {
  LookInput input = Look(head_, test::DoorQuads());
  EXPECT_EQ(dut_.SeeBeyond(input).verdict, Verdict::kTooFewEdges);
  input.images[1].reset();
  EXPECT_EQ(dut_.SeeBeyond(input).verdict, Verdict::kNoImage);
  input.robot.reset();
  EXPECT_EQ(dut_.SeeBeyond(input).verdict, Verdict::kNoPose);
  input.model = nullptr;
  EXPECT_EQ(dut_.SeeBeyond(input).verdict, Verdict::kNoModel);
}

TEST_F(LookEvaluatorTest, WhatALookShowedBeyondADoorTellsTheHeading) {
  std::vector<test::Quad> quads = test::DoorQuads();
  for (const double y : {-0.55, -0.1, 0.3})
    quads.push_back({{3.9, y, 0.8}, {0, 0.2 + y * y, 0}, {0, 0, 0.9}, 90});
  LookInput input = Look(head_, quads);
  ASSERT_EQ(dut_.Evaluate(input).fix.verdict, Verdict::kFound);
  ASSERT_GE(dut_.Beyond(model_.id).edges().size(), 3u);
  input.robot->map_from_base = (Pose2{0, 0, Radians(0.4)} * kTruth).Inverse();
  input.robot->covariance = Eigen::Vector3d(25e-6, 25e-6, 25e-6).asDiagonal();
  const LandmarkFix dut = dut_.SeeBeyond(input);
  ASSERT_EQ(dut.verdict, Verdict::kFound);
  EXPECT_NEAR(dut.base_from_landmark.yaw, kTruth.yaw, Radians(0.15));
}

}  // namespace
}  // namespace priamos::head
