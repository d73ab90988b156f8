#include "cli/report/report_record.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

TEST(RunRecord, SortsStreamsByChannelAndSide) {
  const RunRecord dut = SyntheticRun{}.Record();
  EXPECT_EQ(dut.truth.size(), 951u);
  EXPECT_EQ(dut.poses.size(), 951u);
  EXPECT_EQ(dut.corrections.size(), 2u);
  EXPECT_EQ(dut.looks.size(), 2u);
  EXPECT_EQ(dut.orders.size(), 1u);
  EXPECT_EQ(dut.mission.size(), 2u);
  EXPECT_EQ(dut.onboard_link.size(), 18u);
  EXPECT_EQ(dut.offboard_link.size(), 18u);
  EXPECT_EQ(dut.refused, 0u);
}

TEST(RunRecord, MeasuresTheAgeOfPosesAtTheWorkstation) {
  const RunRecord dut = SyntheticRun{}.Record();
  ASSERT_EQ(dut.pose_ages_s.size(), 75u);
  EXPECT_NEAR(dut.pose_ages_s[0], 0.18, 1e-9);
}

TEST(RunRecord, CopiesOfTheOtherBusAreNotTakenTwice) {
  RunRecord dut;
  Feed(dut, Side::kOffboard, 1, "WORLD_TRUTH", world_truth_t{});
  Feed(dut, Side::kOnboard, 1, "MISSION_STATUS", mission_status_t{});
  EXPECT_TRUE(dut.truth.empty());
  EXPECT_TRUE(dut.mission.empty());
}

TEST(RunRecord, CountsDamagedMessages) {
  RunRecord dut;
  auto bytes = bus::Encode(world_truth_t{});
  bytes.pop_back();
  dut.Add(Side::kOnboard, 0, "WORLD_TRUTH", bytes);
  dut.Add(Side::kOnboard, 0, "WORLD_TRUTH", bus::Encode(pose_t{}));
  dut.Add(Side::kOnboard, 0, "WORLD_TRUTH", {});
  EXPECT_TRUE(dut.truth.empty());
  EXPECT_EQ(dut.refused, 3u);
}

TEST(RunRecord, RefusesPosesThatAreNotNumbers) {
  RunRecord dut;
  pose_t pose{};
  pose.y_m = std::numeric_limits<double>::quiet_NaN();
  Feed(dut, Side::kOnboard, 1, "POSE", pose);
  EXPECT_TRUE(dut.poses.empty());
  EXPECT_EQ(dut.refused, 1u);
}

TEST(RunRecord, IgnoresOtherChannels) {
  RunRecord dut;
  dut.Add(Side::kOnboard, 0, "SOMETHING_ELSE", {});
  EXPECT_EQ(dut.refused, 0u);
}

}  // namespace
}  // namespace priamos::cli
