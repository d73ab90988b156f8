#include "head/core/calibration/rig/head_quality.hpp"

#include <gmock/gmock.h>

#include "test/support/head_sweep.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

class HeadQualityTest : public testing::Test {
 protected:
  HeadQualityTest() {
    CalibrationPlan plan;
    plan.zoom.nodes = 2;
    plan.focus.nodes = 2;
    support::SimulatedHead simulated(12);
    views_ = support::Sweep(simulated, plan.Settings(), {}, 12);
    const auto solved = SolveHead(views_);
    if (!solved) throw std::runtime_error(solved.reason());
    result_ = *solved;
  }
  std::vector<HeadView> views_;
  HeadCalibration result_;
};

TEST_F(HeadQualityTest, TheObjectIsReconstructed) {
  const ReconstructionErrors dut = ReconstructObject(views_, result_.model);
  EXPECT_GT(dut.points, 300);
  EXPECT_LT(dut.rms_m, 0.001);
  EXPECT_GE(dut.max_m, dut.rms_m);
}

TEST_F(HeadQualityTest, AWrongHeadReconstructsBadly) {
  HeadModel wrong = result_.model;
  wrong.geometry.cameras[kRight].yaw_rad += 0.002;
  EXPECT_GT(ReconstructObject(views_, wrong).rms_m, 0.005);
}

TEST_F(HeadQualityTest, WhatTookNoPartIsPredictedAlmostAsWell) {
  const auto dut = PredictHeldOut(views_);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->exposures, 4);
  EXPECT_GT(dut->mean_px, result_.mean_error_px);
  EXPECT_LT(dut->mean_px, 0.3);
}

TEST_F(HeadQualityTest, ViewsThatCannotBeSparedAreNamed) {
  std::erase_if(views_, [](const HeadView& view) { return view.exposure != 0; });
  EXPECT_THAT(PredictHeldOut(views_).reason(), HasSubstr("seen more than once"));
}

}  // namespace
}  // namespace priamos::head
