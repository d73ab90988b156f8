#include "cli/report/report_timeline.hpp"

#include <gtest/gtest.h>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

world_truth_t TruthMessage(double x, double y, double yaw) {
  world_truth_t truth{};
  truth.x_m = x;
  truth.y_m = y;
  truth.yaw_rad = yaw;
  return truth;
}

TEST(ReportTimeline, TruthBetweenTwoMessages) {
  RunRecord record;
  Feed(record, Side::kOnboard, 1, "WORLD_TRUTH", TruthMessage(1, 2, 3.1));
  Feed(record, Side::kOnboard, 2, "WORLD_TRUTH", TruthMessage(2, 4, -3.1));
  const auto dut = TruthAt(record, kRunBegin + 1'250'000);
  ASSERT_TRUE(dut.has_value());
  EXPECT_NEAR(dut->x, 1.25, 1e-9);
  EXPECT_NEAR(dut->y, 2.5, 1e-9);
  EXPECT_NEAR(WrapAngle(dut->yaw - (3.1 + 0.25 * (2 * kPi - 6.2))), 0, 1e-9);
}

TEST(ReportTimeline, NoTruthOutsideTheRecord) {
  RunRecord record;
  Feed(record, Side::kOnboard, 1, "WORLD_TRUTH", TruthMessage(1, 2, 0));
  EXPECT_FALSE(TruthAt(record, kRunBegin).has_value());
  EXPECT_TRUE(TruthAt(record, kRunBegin + 1'000'000).has_value());
  EXPECT_FALSE(TruthAt(record, kRunBegin + 1'000'001).has_value());
}

TEST(ReportTimeline, ErrorIsBeliefMinusTruth) {
  const SyntheticRun run;
  const RunRecord record = run.Record();
  for (const pose_t& pose : record.poses) ASSERT_TRUE(ErrorOf(record, pose).has_value());
  const auto before = ErrorOf(record, record.poses.at(50)), after = ErrorOf(record, record.poses.at(500));
  EXPECT_NEAR(before->position_m, 0.15, 1e-9);
  EXPECT_NEAR(Degrees(before->heading_rad), 4, 1e-9);
  EXPECT_NEAR(after->position_m, 0.01, 1e-9);
}

TEST(ReportTimeline, CrossingIsInterpolatedToThePlane) {
  RunRecord record;
  Feed(record, Side::kOnboard, 1, "WORLD_TRUTH", TruthMessage(5.9, 2.40, 0.0));
  Feed(record, Side::kOnboard, 2, "WORLD_TRUTH", TruthMessage(6.3, 2.44, 0.04));
  const auto dut = CrossingOf(record, {6, 2.4, 0});
  ASSERT_TRUE(dut.has_value());
  EXPECT_EQ(dut->utime, kRunBegin + 1'250'000);
  EXPECT_NEAR(dut->lateral_m, 0.01, 1e-9);
  EXPECT_NEAR(dut->heading_rad, 0.01, 1e-9);
}

TEST(ReportTimeline, CrossingOfATurnedDoorIsMeasuredAcrossItsAxis) {
  RunRecord record;
  Feed(record, Side::kOnboard, 1, "WORLD_TRUTH", TruthMessage(1.02, 1.9, kPi / 2));
  Feed(record, Side::kOnboard, 2, "WORLD_TRUTH", TruthMessage(1.02, 2.1, kPi / 2));
  const auto dut = CrossingOf(record, {1, 2, kPi / 2});
  ASSERT_TRUE(dut.has_value());
  EXPECT_NEAR(dut->lateral_m, -0.02, 1e-9);
  EXPECT_NEAR(dut->heading_rad, 0, 1e-9);
}

TEST(ReportTimeline, ComingBackIsNoCrossing) {
  RunRecord record;
  Feed(record, Side::kOnboard, 1, "WORLD_TRUTH", TruthMessage(6.2, 2.4, 0));
  Feed(record, Side::kOnboard, 2, "WORLD_TRUTH", TruthMessage(5.8, 2.4, 0));
  EXPECT_FALSE(CrossingOf(record, {6, 2.4, 0}).has_value());
}

TEST(ReportTimeline, SpanGoesFromTheOrderToTheEnd) {
  const MissionSpan dut = SpanOf(SyntheticRun{}.Record());
  EXPECT_EQ(dut.begin_utime, kRunBegin + 500'000);
  EXPECT_EQ(dut.end_utime, kRunBegin + 18'500'000);
  EXPECT_TRUE(dut.done);
}

TEST(ReportTimeline, LooksPairRequestsWithAppliedCorrections) {
  RunRecord record = SyntheticRun{}.Record();
  record.corrections[0].verdict = pose_correction_t::IMPLAUSIBLE;
  const auto dut = LooksOf(record);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].side, 2);
  EXPECT_EQ(dut[0].begin_utime, kRunBegin + 4'200'000);
  EXPECT_EQ(dut[0].end_utime, kRunBegin + 5'000'000);
}

}  // namespace
}  // namespace priamos::cli
