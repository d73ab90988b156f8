#include "head/core/bodies/contour_fit.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"
#include "test/head/core/bodies/blurred_cupboard.hpp"

namespace priamos::head {
namespace {

class ContourFitTest : public test::BlurredCupboard {
 protected:
  std::optional<ContourPose> From(const Eigen::Isometry3d& start) const {
    return FitContour(cupboard_.body, start, {&view_, 1}, meters_);
  }
  Eigen::Isometry3d Beside(double shift_m, double turn_rad) const {
    Eigen::Isometry3d start = Eigen::Translation3d(0, shift_m, -shift_m) * truth_;
    start.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(1, 2, -1).normalized()));
    return start;
  }
};

TEST_F(ContourFitTest, ComesToTheTruthFromBesideIt) {
  for (const double sign : {1.0, -1.0}) {
    const auto dut = From(Beside(0.006 * sign, 0.01 * sign));
    ASSERT_TRUE(dut);
    EXPECT_LT((dut->base_from_model.translation() - truth_.translation()).norm(), 0.02);
    const Eigen::AngleAxisd turn((truth_.linear().transpose() * dut->base_from_model.linear()).eval());
    EXPECT_LT(std::abs(turn.angle()), Radians(1));
    EXPECT_GT(dut->covariance.diagonal().minCoeff(), 0);
    EXPECT_GT(dut->seen.edges.size(), 6u);
  }
}

TEST_F(ContourFitTest, BothWaysLeadToOnePose) {
  const auto a = From(Beside(0.006, 0.01)), b = From(Beside(-0.006, -0.01));
  ASSERT_TRUE(a && b);
  EXPECT_LT((a->base_from_model.translation() - b->base_from_model.translation()).norm(), 0.01);
}

TEST_F(ContourFitTest, WhereNothingIsThereIsNoPose) {
  image_ = 60;
  meters_.clear();
  meters_.emplace_back(image_, 1, kBlur_px);
  EXPECT_FALSE(From(truth_));
}

}  // namespace
}  // namespace priamos::head
