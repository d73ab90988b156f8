#include <gtest/gtest.h>

#include <utility>

#include "test/bus/radio/measurement/attack_measurement.hpp"
#include "test/bus/radio/measurement/blackout_measurement.hpp"
#include "test/bus/radio/measurement/first_pose_measurement.hpp"
#include "test/bus/radio/measurement/goodput_measurement.hpp"
#include "test/bus/radio/measurement/overload_measurement.hpp"

// What the link must hold, in short runs. test/bench/radio measures the same for long.

namespace priamos::bus::radio {
namespace {

TEST(LinkMeasurements, SaturatedLineCarriesBundles) {
  const Saturation dut = Saturate(60);
  EXPECT_GT(dut.line_used, 0.995);
  EXPECT_GT(dut.bundle_share, 0.93);
}

TEST(LinkMeasurements, MostOfTheLineIsMessages) {
  EXPECT_GE(GoodputShare(10, 30), 0.75);
  EXPECT_GE(GoodputShare(26, 30), 0.85);
}

TEST(LinkMeasurements, BitErrorsCostNoMoreThanTheyMust) {
  const double clean = EventGoodput(0, 1, 60).bytes_per_s;
  for (const auto& [rate, share] : {std::pair{1e-5, 0.95}, {1e-4, 0.80}, {1e-3, 0.25}}) {
    const Goodput dut = EventGoodput(rate, 2, 60);
    EXPECT_GE(dut.bytes_per_s / clean, share) << rate;
    EXPECT_TRUE(dut.once_in_order) << rate;
  }
}

TEST(LinkMeasurements, OverloadDelaysNeitherCommandsNorEvents) {
  const Overload dut = MeasureOverload(1, 60);
  EXPECT_GT(dut.offered_share, 3);
  EXPECT_GT(dut.timed, 900U);
  EXPECT_LE(dut.worst_bound_used, 1);
  EXPECT_GE(dut.lowest_floor, 0.97);
  EXPECT_LE(dut.worst_queue_age, 1);
}

TEST(LinkMeasurements, BlackoutsReturnFreshAndLoseNoEvent) {
  const Blackouts dut = MeasureBlackouts(1, 400);
  EXPECT_GT(dut.returns, 40);
  EXPECT_LE(dut.slowest_fresh_s, 0.3);
  EXPECT_GT(dut.commands, 100);
  EXPECT_LE(dut.oldest_command_s, 0.25);
  EXPECT_TRUE(dut.events_once_in_order);
}

/// Whatever the blackout cuts, beside all other channels at their rates. Of 4000 returns each, 2 of 1000 take
/// longer than 0.3 s: an answer to a hello goes first.
TEST(LinkMeasurements, AFreshPoseIsThereSoonAfterAnyBlackout) {
  for (const auto& [up, down] : {std::pair{true, true}, {true, false}, {false, true}}) {
    const FirstPoses dut = FirstPoseRun(5, up, down, 1).Run(200);
    EXPECT_GE(dut.ShareWithin(0.3), 0.99) << up << down;
    EXPECT_LE(dut.worst_s(), 0.4) << up << down;
  }
}

TEST(LinkMeasurements, EventsBothWaysThroughLossAndRestarts) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_TRUE(EventsArriveOnceInOrder(seed, 40, 0.3, 0.1)) << seed;
}

TEST(LinkMeasurements, NoDamagedFrameBecomesAMessage) {
  for (const double rate : {1e-4, 1e-3}) {
    const DamagedFrames dut = SendDamagedFrames(rate, 1, 10000);
    EXPECT_GT(dut.rejected, 500U);
    EXPECT_GT(dut.delivered, 1000U);
    EXPECT_EQ(dut.wrong, 0U);
  }
}

TEST(LinkMeasurements, AttackersGetNothingAndAreNoticed) {
  for (const Boot boot : {Boot::kSame, Boot::kLater, Boot::kLaterForgot}) {
    const Attack dut = AttackReceiver(boot, 1, 30000);
    EXPECT_EQ(dut.accepted, 0U);
    EXPECT_EQ(dut.delivered, 0U);
    EXPECT_TRUE(dut.alarm);
    EXPECT_TRUE(dut.still_works) << static_cast<int>(boot);
  }
}

}  // namespace
}  // namespace priamos::bus::radio
