#include "bus/log/log_merge.hpp"

#include <gtest/gtest.h>

#include "bus/log/log_writer.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/packing.hpp"
#include "common/random.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

/// One run of 60 s as both sides record it: poses at 50 Hz onboard, every 13th carried by the radio; the
/// offboard clock is 7.25 s ahead and gains 50 ppm.
class MergeTest : public testing::Test {
 protected:
  static constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
  static std::int64_t Offboard(std::int64_t onboard_us) {
    return onboard_us + 7'250'000 + (onboard_us - kStart_us) / 20'000;
  }

  void SetUp() override {
    LogWriter onboard(folder_ / "onboard.lcmlog"), offboard(folder_ / "offboard.lcmlog");
    const Packer packer(*schema_.Find("pose_t"));
    Rng rng(1);
    for (int i = 0; i < 3000; ++i) {
      const std::int64_t now = kStart_us + i * 20'000;
      pose_t pose{};
      pose.utime = now - 1'500;
      pose.x_m = 0.3 * i / 50;
      pose.yaw_rad = 0.3 * rng.Uniform(-1, 1);
      const auto bytes = Encode(pose);
      onboard.Write(now, "POSE", bytes);
      if (i % 13 != 0) continue;
      // The radio is told the age at sending, and takes the time on the way off at the other end.
      const std::int64_t sent = now + static_cast<std::int64_t>(rng.Below(20'000));
      const std::int64_t on_the_way = 30'000 + static_cast<std::int64_t>(rng.Below(90'000));
      const auto packed = packer.Pack(bytes, sent);
      const auto there = packer.Unpack(packed->bytes, Offboard(sent));
      offboard.Write(Offboard(sent + on_the_way), "POSE", *there);
    }
    offboard.Write(Offboard(kStart_us + 1'000'000), "ONLY_HERE", std::vector<std::byte>(10));
  }
  TemporaryFolder folder_;
  Schema schema_ = OwnTypes();
};

TEST_F(MergeTest, MessagesThatCrossedTheRadioTellTheClocks) {
  LogReader onboard(folder_ / "onboard.lcmlog"), offboard(folder_ / "offboard.lcmlog");
  const auto pairs = FindStampPairs(onboard, offboard, schema_);
  EXPECT_GT(pairs.size(), 150u);
  EXPECT_TRUE(pairs.front().from_a);
  const auto fit = FitClocks(pairs);
  ASSERT_TRUE(fit);
  for (const int second : {0, 30, 60}) {
    const std::int64_t now = kStart_us + second * 1'000'000;
    EXPECT_NEAR(static_cast<double>(fit->ToA(Offboard(now)) - now), 0, 6'000) << second;
  }
}

TEST_F(MergeTest, MergedEventsAreInOneTimeLine) {
  LogReader onboard(folder_ / "onboard.lcmlog"), offboard(folder_ / "offboard.lcmlog");
  const auto fit = FitClocks(FindStampPairs(onboard, offboard, schema_));
  const std::string merged = folder_ / "merged.lcmlog";
  {
    LogWriter writer(merged);
    EXPECT_EQ(MergeLogs(onboard, offboard, *fit, "OFFBOARD_", writer), 3000u + 231u + 1u);
  }
  LogReader dut(merged);
  std::int64_t before = 0;
  int crossed = 0, events = 0;
  std::map<double, std::int64_t> sent;  // by the pose's x
  while (const auto event = dut.Next()) {
    if (event->channel != "OFFBOARD_ONLY_HERE") {
      EXPECT_GE(event->utime, before);
      before = event->utime;
    }
    ++events;
    crossed += event->channel == "OFFBOARD_POSE";
  }
  EXPECT_EQ(events, 3232);
  EXPECT_EQ(crossed, 231);
}

TEST_F(MergeTest, LogsOfDifferentRunsHaveNothingInCommon) {
  {
    LogWriter other(folder_ / "other.lcmlog");
    pose_t pose{};
    pose.x_m = 77;
    other.Write(kStart_us, "POSE", Encode(pose));
  }
  LogReader onboard(folder_ / "onboard.lcmlog"), other(folder_ / "other.lcmlog");
  EXPECT_TRUE(FindStampPairs(onboard, other, schema_).empty());
}

}  // namespace
}  // namespace priamos::bus
