#include "cli/report/report_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

TEST(ReportSummary, PassedRun) {
  const Summary dut = Summarise(SyntheticRun{}.Record(), TestInfo());
  EXPECT_TRUE(dut.passed);
  EXPECT_EQ(dut.contacts, 0);
  EXPECT_NEAR(dut.min_gap_m, 0.052, 1e-9);
  EXPECT_NEAR(*dut.lateral_at_door_m, 0.006, 1e-9);
  EXPECT_NEAR(*dut.heading_at_door_deg, Degrees(0.004), 1e-9);
  EXPECT_NEAR(dut.duration_s, 18, 1e-9);
  EXPECT_NEAR(dut.mean_speed_m_s, 0.3, 0.01);
  EXPECT_NEAR(*dut.min_speed_during_fix_m_s, 0.3, 1e-9);
}

TEST(ReportSummary, FixesAreJudgedByTheTruth) {
  const Summary dut = Summarise(SyntheticRun{}.Record(), TestInfo());
  ASSERT_EQ(dut.fixes.size(), 2u);
  EXPECT_NEAR(dut.fixes[0].t_s, 3.5, 1e-9);
  EXPECT_NEAR(dut.fixes[0].error_before_m, 0.15, 1e-9);
  EXPECT_NEAR(dut.fixes[0].error_before_deg, 4, 1e-9);
  EXPECT_NEAR(dut.fixes[1].error_after_m, 0.01, 1e-9);
  EXPECT_NEAR(dut.fixes[1].error_after_deg, 0.2, 1e-9);
  EXPECT_NEAR(dut.fixes[1].sigma_m, 0.010, 1e-9);
}

TEST(ReportSummary, PosesWithinFortyMillisecondsOfACorrectionAreNotJudged) {
  RunRecord record = SyntheticRun{}.Record();
  const std::int64_t corrected = kRunBegin + 5'000'000;
  int changed = 0;
  for (pose_t& pose : record.poses) {
    if (std::abs(pose.utime - corrected) >= 40'000) continue;
    pose.x_m += 1;
    ++changed;
  }
  EXPECT_EQ(changed, 3);
  const FixSummary second = Summarise(record, TestInfo()).fixes.at(1);
  EXPECT_NEAR(second.error_before_m, std::hypot(0.02, 0.03), 1e-9);
  EXPECT_NEAR(second.error_after_m, 0.01, 1e-9);
}

TEST(ReportSummary, CreepingBeforeTheDriveIsNotInTheMeanSpeed) {
  RunRecord record = SyntheticRun{}.Record();
  for (world_truth_t& truth : record.truth)
    if (truth.vx_m_s == 0) truth.vx_m_s = 0.01;
  EXPECT_NEAR(Summarise(record, TestInfo()).mean_speed_m_s,
              Summarise(SyntheticRun{}.Record(), TestInfo()).mean_speed_m_s, 1e-9);
}

TEST(ReportSummary, UpIsFromTheRobotDownFromTheWorkstation) {
  const Summary dut = Summarise(SyntheticRun{}.Record(), TestInfo());
  EXPECT_NEAR(dut.up.utilisation, 0.2, 1e-9);
  EXPECT_NEAR(dut.down.utilisation, 0.05, 1e-9);
  EXPECT_EQ(dut.up.bytes, 3600);
  ASSERT_EQ(dut.up.channels.size(), 1u);
  EXPECT_EQ(dut.up.channels[0].channel, "POSE");
  EXPECT_EQ(dut.down.channels[0].channel, "LOOK_REQUEST");
}

TEST(ReportSummary, MissionThatFailedHasNotPassed) {
  EXPECT_FALSE(Summarise(SyntheticRun{.done = false}.Record(), TestInfo()).passed);
}

TEST(ReportSummary, MissionThatOnlyBelievesToBeThroughHasNotPassed) {
  const Summary dut = Summarise(SyntheticRun{.end_s = 12}.Record(), TestInfo());
  EXPECT_FALSE(dut.passed);
  EXPECT_FALSE(dut.lateral_at_door_m.has_value());
}

TEST(ReportSummary, StandingWhileFixingIsSeen) {
  RunRecord record = SyntheticRun{}.Record();
  record.truth[175].vx_m_s = 0.05;  // at 3.5 s
  record.truth[300].vx_m_s = 0.01;  // at 6.0 s, no look
  EXPECT_NEAR(*Summarise(record, TestInfo()).min_speed_during_fix_m_s, 0.05, 1e-9);
}

TEST(ReportSummary, EmptyRecordHasNotPassed) {
  const Summary dut = Summarise(RunRecord{}, TestInfo());
  EXPECT_FALSE(dut.passed);
  EXPECT_TRUE(dut.fixes.empty());
  EXPECT_FALSE(dut.min_speed_during_fix_m_s.has_value());
  EXPECT_EQ(ToJson(dut)["lateral_at_door_m"], nullptr);
}

TEST(ReportSummary, ThingsThatWereToldAreJudged) {
  RunRecord record = SyntheticRun{}.Record();
  EXPECT_EQ(ToJson(Summarise(record, TestInfo()))["things"], nullptr);
  scene_object_t told{};
  told.utime_seen = record.truth[100].utime;
  told.kind = scene_object_t::FACE;
  told.width_m = 0.6;
  told.top_m = 1;
  told.looks = 2;
  record.objects.push_back(told);
  const auto dut = ToJson(Summarise(record, TestInfo()))["things"];
  EXPECT_EQ(dut["told"], 1);
  EXPECT_EQ(dut["faces"], 1);
  EXPECT_EQ(dut["standing"].get<int>() + dut["phantoms"].get<int>(), 1);
  EXPECT_TRUE(dut.contains("front_p95_m"));
}

TEST(ReportSummary, JsonHasExactlyTheAgreedKeys) {
  const auto dut = ToJson(Summarise(SyntheticRun{}.Record(), TestInfo()));
  const auto keys = [](const nlohmann::ordered_json& json) {
    std::vector<std::string> names;
    for (const auto& [key, value] : json.items()) names.push_back(key);
    return names;
  };
  EXPECT_EQ(keys(dut), (std::vector<std::string>{"scenario",
                                                 "seed",
                                                 "passed",
                                                 "reason",
                                                 "contacts",
                                                 "touches",
                                                 "min_gap_m",
                                                 "lateral_at_door_m",
                                                 "heading_at_door_deg",
                                                 "belief_at_door",
                                                 "corrections",
                                                 "corridor",
                                                 "doors",
                                                 "things",
                                                 "explore",
                                                 "duration_s",
                                                 "mean_speed_m_s",
                                                 "min_speed_during_fix_m_s",
                                                 "fixes",
                                                 "hand",
                                                 "radio",
                                                 "realtime_factor"}));
  EXPECT_EQ(keys(dut["fixes"][0]),
            (std::vector<std::string>{"t_s", "error_before_m", "error_before_deg", "error_after_m",
                                      "error_after_deg", "sigma_m", "sigma_deg"}));
  EXPECT_EQ(keys(dut["radio"]), (std::vector<std::string>{"up", "down"}));
  EXPECT_EQ(keys(dut["radio"]["up"]),
            (std::vector<std::string>{"bytes", "utilisation", "frames", "dropped"}));
  EXPECT_EQ(dut["seed"], 7);
}

}  // namespace
}  // namespace priamos::cli
