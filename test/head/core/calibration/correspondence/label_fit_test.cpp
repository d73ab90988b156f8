#include "head/core/calibration/correspondence/label_fit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "test/support/calibration_scene.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class LabelFitTest : public testing::Test {
 protected:
  LabelFitTest() {
    truth_.camera_from_object << 0, 1, 0, 0, 0, -1, -1, 0, 0;  // before the object's front, upright
    truth_.camera_from_object = Eigen::AngleAxisd(0.25, Vector3d::UnitY()) * truth_.camera_from_object;
    truth_.offset_m = {0, 0, 1.6};
    truth_.focal_px = 1100;
    for (const ReferenceDisc& disc : object_.discs) {
      double spacing = 1e9;
      for (const ReferenceDisc& other : object_.discs)
        if (const double d = (other.centre_m - disc.centre_m).norm(); d > 0) spacing = std::min(spacing, d);
      spacing_m_.push_back(spacing);
      DetectedDisc& seen = detections_.emplace_back();
      seen.ellipse = *ProjectDisc(truth_.Model().image_from_base, disc);
      seen.ellipse.centre_px = *ProjectDiscCentroid(truth_.Model(), disc);
    }
  }
  LabelFit Fit() const { return {object_, options_, spacing_m_, detections_}; }
  int Count() const { return static_cast<int>(object_.discs.size()); }
  /// Every disc is the detection of its own number, but for those that are left out.
  std::vector<DiscLabel> All(int without = -1) const {
    std::vector<DiscLabel> labels;
    for (int i = 0; i < Count(); ++i)
      if (i != without) labels.push_back({i, i});
    return labels;
  }
  /// The truth as a first guess knows it.
  PinholeView Rough() const {
    PinholeView rough = truth_;
    rough.camera_from_object =
        Eigen::AngleAxisd(0.03, Vector3d(1, 2, 3).normalized()) * rough.camera_from_object;
    rough.offset_m += Vector3d(0.005, -0.005, 0.05);
    rough.focal_px *= 1.04;
    return rough;
  }

  const ReferenceObject object_ = support::ShippedReferenceObject();
  LabellerOptions options_;
  std::vector<double> spacing_m_;
  PinholeView truth_;
  std::vector<DetectedDisc> detections_;
};

TEST_F(LabelFitTest, AllButTheHiddenDiscsAreNeededAndNeverFewerThanSeven) {
  options_.max_hidden = 6;
  EXPECT_EQ(Fit().Needed(), object_.discs.size() - 6);
  options_.max_hidden = 0;
  EXPECT_EQ(Fit().Needed(), object_.discs.size());
  options_.max_hidden = Count() - 3;
  EXPECT_EQ(Fit().Needed(), 7u);
  options_.max_hidden = 1000;
  EXPECT_EQ(Fit().Needed(), 7u);
  EXPECT_TRUE(Fit().Enough(7));
  EXPECT_FALSE(Fit().Enough(6));
}

TEST_F(LabelFitTest, WhereTheViewShowsDiscsTheyAreMatched) {
  EXPECT_EQ(Fit().Match(truth_, 0.1, 2, 1.1), All());
}

TEST_F(LabelFitTest, ADetectionBeyondTheToleranceIsNoDisc) {
  detections_[4].ellipse.centre_px += Vector2d(5, 0);
  EXPECT_EQ(Fit().Match(truth_, 0, 4, 1.1), All(4));
  EXPECT_EQ(Fit().Match(truth_, 0, 8, 1.1), All());
}

TEST_F(LabelFitTest, TheToleranceIsAShareOfTheSpacing) {
  const double depth_m = truth_.InCamera(object_.discs[4].centre_m).z();
  const double spacing_px = spacing_m_[4] * truth_.focal_px / depth_m;
  detections_[4].ellipse.centre_px += Vector2d(0.1 * spacing_px, 0);
  EXPECT_EQ(Fit().Match(truth_, 0.08, 0.5, 1.1), All(4));
  EXPECT_EQ(Fit().Match(truth_, 0.12, 0.5, 1.1), All());
}

TEST_F(LabelFitTest, ADetectionOfAnotherSizeIsNoDisc) {
  detections_[7].ellipse.shape_px2 *= 1.3 * 1.3;
  EXPECT_EQ(Fit().Match(truth_, 0.1, 2, 1.1), All(7));
  EXPECT_EQ(Fit().Match(truth_, 0.1, 2, 1.4), All());
  detections_[7].ellipse.shape_px2 /= 1.3 * 1.3 * 1.3 * 1.3;
  EXPECT_EQ(Fit().Match(truth_, 0.1, 2, 1.1), All(7));
}

TEST_F(LabelFitTest, OfTwoDetectionsTheNearerOneIsTheDisc) {
  detections_.push_back(detections_[3]);
  detections_.back().ellipse.centre_px += Vector2d(0.5, 0);
  EXPECT_EQ(Fit().Match(truth_, 0.1, 2, 1.1), All());
  detections_[3].ellipse.centre_px += Vector2d(0, 1);
  auto expected = All();
  expected[3].detection = Count();
  EXPECT_EQ(Fit().Match(truth_, 0.1, 2, 1.1), expected);
}

TEST_F(LabelFitTest, OneDetectionIsOneDisc) {
  // Only one is there; every disc looks for it.
  detections_ = {detections_[5]};
  const auto dut = Fit().Match(truth_, 0, 1e4, 1e3);
  EXPECT_EQ(dut, (std::vector<DiscLabel>{{5, 0}}));
}

TEST_F(LabelFitTest, BehindTheCameraNothingIsMatched) {
  PinholeView away = truth_;
  away.offset_m.z() = -1.6;
  EXPECT_TRUE(Fit().Match(away, 10, 1e4, 1e3).empty());
}

TEST_F(LabelFitTest, ARoughViewGrowsToTheWholeLabelling) {
  const LabelFit fit = Fit();
  const auto dut = fit.Grow(Rough());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->labels, All());
  EXPECT_LT(dut->rms_px, 0.02);
  EXPECT_NEAR(dut->view.focal_px, truth_.focal_px, 5);
  EXPECT_LT((dut->view.offset_m - truth_.offset_m).norm(), 0.02);
  EXPECT_EQ(fit.most_labels(), object_.discs.size());
}

TEST_F(LabelFitTest, ADetectionThatIsSlightlyOffIsLeftOut) {
  detections_[9].ellipse.centre_px += Vector2d(1.5, -1.5);
  const auto dut = Fit().Grow(Rough());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->labels, All(9));
  EXPECT_LT(dut->rms_px, 0.05);
}

TEST_F(LabelFitTest, AWrongViewDoesNotGrow) {
  PinholeView wrong = truth_;
  wrong.camera_from_object = truth_.camera_from_object * Eigen::AngleAxisd(1.5, Vector3d::UnitX());
  EXPECT_FALSE(Fit().Grow(wrong));
  wrong = truth_;
  wrong.offset_m += Vector3d(3, 0, 0);
  EXPECT_FALSE(Fit().Grow(wrong));
}

TEST_F(LabelFitTest, TooFewDetectionsAreNoLabellingButAreCounted) {
  options_.max_hidden = 4;
  detections_.resize(detections_.size() - 5);
  const LabelFit fit = Fit();
  EXPECT_FALSE(fit.Grow(Rough()));
  EXPECT_EQ(fit.most_labels(), object_.discs.size() - 5);
  options_.max_hidden = 5;
  EXPECT_TRUE(Fit().Grow(Rough()));
}

TEST_F(LabelFitTest, ALabellingThatIsTooInexactIsNone) {
  Rng rng(6);
  for (DetectedDisc& d : detections_) d.ellipse.centre_px += Vector2d(rng.Normal(0.25), rng.Normal(0.25));
  options_.max_rms_px = 1;
  ASSERT_TRUE(Fit().Grow(Rough()));
  options_.max_rms_px = 0.1;
  EXPECT_FALSE(Fit().Grow(Rough()));
}

TEST_F(LabelFitTest, AFocalLengthFarFromWhatIsKnownIsNotBelieved) {
  ASSERT_TRUE(Fit().Grow(Rough()));
  options_.min_focal_px = 3000;
  options_.max_focal_px = 4000;
  EXPECT_FALSE(Fit().Grow(Rough()));
}

RC_GTEST_PROP(SimilarSize, DoesNotDependOnTheOrderOrTheUnit, ()) {
  const double a = support::Between(0.1, 50), b = support::Between(0.1, 50),
               ratio = support::Between(1.05, 2);
  RC_PRE(std::abs(std::max(a, b) / std::min(a, b) - ratio) > 1e-9);
  RC_ASSERT(SimilarSize(a, b, ratio) == SimilarSize(b, a, ratio));
  RC_ASSERT(SimilarSize(a, b, ratio) == SimilarSize(2 * a, 2 * b, ratio));
  RC_ASSERT(SimilarSize(a, b, ratio) == (std::max(a, b) / std::min(a, b) < ratio));
}

}  // namespace
}  // namespace priamos::head
