#include "head/core/bodies/guided_views.hpp"

#include <gtest/gtest.h>

#include "head/core/bodies/free_model_fix.hpp"
#include "head/core/edges/scale_edges.hpp"
#include "test/head/core/bodies/blurred_cupboard.hpp"

namespace priamos::head {
namespace {

/// With the edges that the operator finds.
class GuidedViewsTest : public test::BlurredCupboard {
 protected:
  GuidedViewsTest() {
    ScaleEdgeOperator().Extract(image_, found_);
    view_ = MakeView(camera_, found_.edges);
    view_.blur_px = found_.MedianBlur();
  }

  BlurredEdges found_;
};

TEST_F(GuidedViewsTest, EachMeasuredEdgeIsThereOnce) {
  const auto seen = VisibleSkeleton(cupboard_.body, truth_.inverse() * OpticalCentre(camera_));
  std::vector<GuidedEdges> guides;
  guides.emplace_back(image_, 1, view_.blur_px);
  const GuidedViews dut(seen, truth_, {&view_, 1}, guides);
  ASSERT_EQ(dut.views().size(), 1u);
  const CameraView& view = dut.views()[0];
  EXPECT_EQ(view.blur_px, view_.blur_px);
  EXPECT_EQ(view.lines.size(), view.edges->segments.size());
  for (const EdgeSegment& a : view.edges->segments) {
    int n_alike = 0;
    for (const EdgeSegment& b : view.edges->segments)
      n_alike += (a.centre - b.centre).norm() < 3 && a.direction().dot(b.direction()) > 0.99;
    EXPECT_EQ(n_alike, 1);
  }
}

TEST_F(GuidedViewsTest, ABlurredBodyAgreesMoreWhenItsImageIsAtHand) {
  const auto without = LocateFreeModel(cupboard_.body, truth_, {&view_, 1}, {});
  view_.image = &image_;
  const auto with = LocateFreeModel(cupboard_.body, truth_, {&view_, 1}, {});
  EXPECT_EQ(with.verdict, Verdict::kFound) << Describe(with.verdict);
  EXPECT_GE(with.n_matched, without.n_matched);
  EXPECT_LT((with.base_from_model.translation() - truth_.translation()).norm(), 0.02);
}

}  // namespace
}  // namespace priamos::head
