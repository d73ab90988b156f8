#include "cli/report/report_belief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

constexpr double kAfterFixes_s = 14;

std::int64_t At(double t_s) {
  return kRunBegin + std::llround(t_s * 1e6);
}

DoorPlan DoorTurnedBy(double yaw_deg) {
  DoorPlan door = *TestInfo().door;
  door.yaw_deg = yaw_deg;
  return door;
}

TEST(ReportBelief, IsBeliefMinusTruthInTheFrameOfTheDoor) {
  const RunRecord record = SyntheticRun{}.Record();
  const auto dut = BeliefAt(record, DoorTurnedBy(0), At(kAfterFixes_s));
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->along_m, 0.006, 1e-9);
  EXPECT_NEAR(dut->lateral_m, 0.008, 1e-9);
  EXPECT_NEAR(Degrees(dut->heading_rad), 0.2, 1e-9);
  EXPECT_NEAR(dut->lateral_sigma_m, 0.017, 1e-9);
  const auto turned = BeliefAt(record, DoorTurnedBy(90), At(kAfterFixes_s));
  EXPECT_NEAR(turned->along_m, 0.008, 1e-9);
  EXPECT_NEAR(turned->lateral_m, -0.006, 1e-9);
  EXPECT_NEAR(turned->lateral_sigma_m, 0.019, 1e-9);
}

TEST(ReportBelief, NeesWeighsTheErrorByTheCovariance) {
  const auto dut = BeliefAt(SyntheticRun{}.Record(), DoorTurnedBy(0), At(kAfterFixes_s));
  const double x = 0.006 / 0.019, y = 0.008 / 0.017, rho = 0.3;
  EXPECT_NEAR(dut->nees, (x * x - 2 * rho * x * y + y * y) / (1 - rho * rho) + 1, 1e-6);
}

TEST(ReportBelief, NothingIsSaidOfATimeWithoutPose) {
  EXPECT_FALSE(BeliefAt(SyntheticRun{}.Record(), DoorTurnedBy(0), At(100)));
  EXPECT_FALSE(BeliefAt(RunRecord{}, DoorTurnedBy(0), At(1)));
}

void Correct(RunRecord& record, std::int8_t verdict, double distance) {
  pose_correction_t correction{};
  correction.verdict = verdict;
  correction.distance = distance;
  record.corrections.push_back(correction);
}

TEST(CorrectionsOf, CountsThoseBeyondThreeSigmasAppliedOrRefused) {
  RunRecord record;
  Correct(record, pose_correction_t::APPLIED, 0.7);
  Correct(record, pose_correction_t::APPLIED, 3.7);
  Correct(record, pose_correction_t::APPLIED, 3.8);
  Correct(record, pose_correction_t::IMPLAUSIBLE, 9.5);
  const CorrectionSummary dut = CorrectionsOf(record);
  EXPECT_EQ(dut.count, 4);
  EXPECT_EQ(dut.beyond_3_sigma, 2);
  EXPECT_DOUBLE_EQ(dut.most_distance, 9.5);
  EXPECT_EQ(ToJson(dut).dump(), R"({"count":4,"beyond_3_sigma":2,"most_distance":9.5})");
}

TEST(CorrectionsOf, WhatWasNeverComparedDoesNotCount) {
  RunRecord record;
  for (const std::int8_t verdict : {pose_correction_t::NOT_FOUND, pose_correction_t::TOO_OLD,
                                    pose_correction_t::RESET, pose_correction_t::MOVING})
    Correct(record, verdict, 5);
  Correct(record, pose_correction_t::IMPLAUSIBLE, 0);
  Correct(record, pose_correction_t::APPLIED, NAN);
  EXPECT_EQ(CorrectionsOf(record).count, 0);
}

TEST(CorrectionsOf, TheBoundIsThatOfThreeDegreesOfFreedom) {
  const double d = kThreeSigmas;  // chi-square of 3: erfc(d / sqrt 2) + sqrt(2 / pi) d exp(-d^2 / 2)
  const double beyond = std::erfc(d / std::sqrt(2)) + std::sqrt(2 / std::acos(-1)) * d * std::exp(-d * d / 2);
  EXPECT_NEAR(beyond, std::erfc(3 / std::sqrt(2)), 1e-5);
}

}  // namespace
}  // namespace priamos::cli
