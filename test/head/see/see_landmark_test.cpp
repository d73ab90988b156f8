#include "head/see/see_landmark.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/geometry.hpp"
#include "test/support/drawn_shapes.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;
using testing::ElementsAre;
using testing::IsEmpty;

RC_GTEST_PROP(PoseFromSix, ComesBackAsTheSameSixNumbers, ()) {
  const std::vector<double> six{Between(-5, 5),     Between(-5, 5),   Between(-5, 5),
                                Between(-179, 179), Between(-89, 89), Between(-179, 179)};
  const auto dut = SixFromPose(PoseFromSix(six));
  for (int i = 0; i < 6; ++i) RC_ASSERT(std::abs(dut[i] - six[i]) < 1e-9);
}

RC_GTEST_PROP(PoseFromSix, IsAMotionOfARigidBody, ()) {
  const auto dut = PoseFromSix({1, 2, 3, Between(-400, 400), Between(-400, 400), Between(-400, 400)});
  RC_ASSERT((dut.linear() * dut.linear().transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  RC_ASSERT(std::abs(dut.linear().determinant() - 1) < 1e-12);
  RC_ASSERT(dut.translation() == Vector3d(1, 2, 3));
}

TEST(PoseFromSixTest, AnglesTurnAboutFixedAxesRollFirst) {
  const auto turned = [](double roll, double pitch, double yaw, const Vector3d& v) -> Vector3d {
    return PoseFromSix({0, 0, 0, roll, pitch, yaw}) * v;
  };
  EXPECT_LT((turned(90, 0, 0, Vector3d::UnitY()) - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((turned(0, 90, 0, Vector3d::UnitZ()) - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((turned(0, 0, 90, Vector3d::UnitX()) - Vector3d::UnitY()).norm(), 1e-12);
  // y by roll to z, by pitch to x, by yaw to y.
  EXPECT_LT((turned(90, 90, 90, Vector3d::UnitY()) - Vector3d::UnitY()).norm(), 1e-12);
}

TEST(PoseFromSixTest, StraightUpStillHasNumbers) {
  const auto dut = SixFromPose(PoseFromSix({0, 0, 0, 0, 90, 0}));
  EXPECT_NEAR(dut[4], 90, 1e-5);
  for (const double v : dut) EXPECT_TRUE(std::isfinite(v));
}

TEST(PoseFromSixTest, OtherNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& n : {std::vector<double>{},
                                       {1, 2, 3, 4, 5},
                                       {1, 2, 3, 4, 5, 6, 7},
                                       {nan, 0, 0, 0, 0, 0},
                                       {0, 0, 0, 0, 0, INFINITY}})
    EXPECT_EQ(support::ThrownReason([&] { PoseFromSix(n); }),
              "expected six finite numbers: x y z [m] roll pitch yaw [deg]");
}

/// A square plate across the axis of a camera that looks along x.
class SeeLandmark : public testing::Test {
 protected:
  static constexpr int kWidth = 640, kHeight = 480;
  SeeLandmark() {
    camera_.image_from_base << 320, -500, 0, 0, 240, 0, -500, 0, 1, 0, 0, 0;  // u to the right of y left
    body_.points = {{0, 0.5, 0.5}, {0, 0.5, -0.5}, {0, -0.5, -0.5}, {0, -0.5, 0.5}};
    body_.faces = {{0, 1, 2, 3}};
    edges_.width = kWidth;
    edges_.height = kHeight;
    edges_.segments.resize(3);
    for (int i = 0; i < 3; ++i) {
      edges_.segments[i].begin = {100.0 + i, 10};
      edges_.segments[i].end = {100.0 + i, 90};
      view_.lines.emplace_back().segment = 2 - i;  // the lines count backwards
    }
    view_.camera = &camera_;
    view_.edges = &edges_;
    view_.size = {kWidth, kHeight};
    fix_.base_from_model = believed_;
    fix_.seen.edges = {{.from = {0, 0.5, 0.5}, .to = {0, 0.5, -0.5}},
                       {.from = {0, 0.5, -0.5}, .to = {0, -0.5, -0.5}}};
    EdgeMatch match;
    match.edge = 1;
    match.camera = 0;
    match.lines = {0, 2};
    fix_.matches = {match};
  }
  SeePage Draw() const {
    return DrawLandmark(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(90)), std::span(&view_, 1), body_,
                        believed_, fix_);
  }
  std::size_t Lines(const char* layer) const {
    return support::LinesOn(Draw().drawing(), layer, kHeight).size();
  }

  CameraModel camera_;
  EdgeImage edges_;
  CameraView view_;
  Polyhedron body_;
  const Eigen::Isometry3d believed_{Eigen::Translation3d(4, 0, 0)};
  FreeModelFix fix_;
};

TEST_F(SeeLandmark, WithoutAFixOnlyTheBeliefIsDrawn) {
  fix_.verdict = Verdict::kTooFewEdges;
  EXPECT_EQ(Lines("edge"), 3u);
  EXPECT_EQ(Lines("believed"), 4u);
  EXPECT_EQ(Lines("found"), 0u);
  EXPECT_EQ(Lines("matched"), 0u);
}

TEST_F(SeeLandmark, ThePlateIsDrawnWhereTheCameraSeesIt) {
  const SeePage dut = Draw();
  for (const drawing::Path& line : support::LinesOn(dut.drawing(), "believed", kHeight))
    for (const Vector2d& at : line.points) {
      // Half a metre to either side at four metres; half a pixel from the corner of the page.
      EXPECT_NEAR(std::abs(at.x() - 320.5), 62.5, 0.01);
      EXPECT_NEAR(std::abs(at.y() - 240.5), 62.5, 0.01);
    }
}

TEST_F(SeeLandmark, AFixIsDrawnWithTheEdgesThatWereTakenForIt) {
  fix_.verdict = Verdict::kFound;
  EXPECT_EQ(Lines("found"), 2u);
  const auto matched = support::LinesOn(Draw().drawing(), "matched", kHeight);
  ASSERT_EQ(matched.size(), 2u);
  EXPECT_EQ(matched[0].points[0].x(), 102.5);  // line 0 is segment 2
  EXPECT_EQ(matched[1].points[0].x(), 100.5);
  fix_.matches[0].camera = 1;
  EXPECT_EQ(Lines("matched"), 0u) << "of another image";
}

TEST_F(SeeLandmark, APlateSeenFromBehindShowsNoEdges) {
  std::reverse(body_.faces[0].begin(), body_.faces[0].end());
  EXPECT_EQ(Lines("believed"), 0u);
}

TEST_F(SeeLandmark, JsonOfWhatWasNotFoundHasTheReasonAlone) {
  fix_.verdict = Verdict::kAmbiguous;
  const auto dut = LandmarkToJson(std::span(&view_, 1), fix_);
  EXPECT_EQ(dut["found"], false);
  EXPECT_EQ(dut["verdict"], Describe(Verdict::kAmbiguous));
  EXPECT_EQ(dut.size(), 2u);
}

TEST_F(SeeLandmark, JsonOfAFixHasPoseSigmasAndMatches) {
  fix_.verdict = Verdict::kFound;
  fix_.base_from_model = PoseFromSix({1, 2, 3, 10, 20, 30});
  fix_.covariance.diagonal() << 1e-4, 4e-4, -1e-20, std::pow(Radians(1), 2), std::pow(Radians(2), 2), 0;
  fix_.residual_px = 0.25;
  fix_.misfit = 1.5;
  const auto dut = LandmarkToJson(std::span(&view_, 1), fix_);
  EXPECT_EQ(dut["found"], true);
  EXPECT_THAT(dut["pose_m_deg"].get<std::vector<double>>(),
              testing::Pointwise(testing::DoubleNear(1e-9), {1., 2., 3., 10., 20., 30.}));
  EXPECT_THAT(dut["sigma_m"].get<std::vector<double>>(),
              testing::Pointwise(testing::DoubleNear(1e-12), {0.01, 0.02, 0.}));
  EXPECT_THAT(dut["sigma_deg"].get<std::vector<double>>(),
              testing::Pointwise(testing::DoubleNear(1e-9), {1., 2., 0.}));
  EXPECT_EQ(dut["residual_px"], 0.25);
  EXPECT_EQ(dut["misfit"], 1.5);
  ASSERT_EQ(dut["matches"].size(), 1u);
  EXPECT_EQ(dut["matches"][0]["image"], 0);
  EXPECT_EQ(dut["matches"][0]["from_m"].dump(), "[0.0,0.5,-0.5]");
  EXPECT_EQ(dut["matches"][0]["to_m"].dump(), "[0.0,-0.5,-0.5]");
  EXPECT_EQ(dut["matches"][0]["segments"].dump(), "[2,0]");
}

}  // namespace
}  // namespace priamos::head
