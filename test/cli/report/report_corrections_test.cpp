#include "cli/report/report_corrections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace priamos::cli {
namespace {

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
