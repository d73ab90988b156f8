#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "bus/radio/budget.hpp"
#include "test/bus/radio/measurement/attack_measurement.hpp"
#include "test/bus/radio/measurement/blackout_measurement.hpp"
#include "test/bus/radio/measurement/command_measurement.hpp"
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

/// Whatever the blackout cuts, beside all other channels at their rates. Of 4000 returns each, 3 to 5 of 1000
/// take longer than 0.3 s.
TEST(LinkMeasurements, AFreshPoseIsThereSoonAfterAnyBlackout) {
  for (const auto& [up, down] : {std::pair{true, true}, {true, false}, {false, true}}) {
    const FirstPoses dut = FirstPoseRun(5, up, down, 1).Run(200);
    EXPECT_GE(dut.ShareWithin(0.3), 0.99) << up << down;
    EXPECT_LE(dut.worst_s(), 0.4) << up << down;
  }
}

/// The row of a channel in the budget of the shipped link.
ChannelBudget BudgetOf(const std::string& name) {
  const LinkConfig link = ShippedLink();
  const ChannelTable table = link.Table(OwnTypes());
  const Budget budget = ComputeBudget(table, link.Options());
  for (const DirectionBudget* d : {&budget.up, &budget.down})
    for (const ChannelBudget& row : d->channels)
      if (table.at(row.channel).name == name) return row;
  return {};
}

/// Between two poses, which their rate keeps apart, goes a frame without one; most often that of a message
/// which is longer than a bundle. Nothing but an emergency stop cuts it off. With the poses' own frames that
/// is up to 0.5 s. While the way up is dark, frames are short, and without such messages every pose comes in
/// time.
TEST(LinkMeasurements, ALateFirstPoseComesBehindAFrameWithoutOne) {
  const ChannelBudget pose = BudgetOf("POSE"), health = BudgetOf("HEALTH");
  ASSERT_GT(health.bits, 8U * static_cast<unsigned>(ShippedLink().max_bundle_bytes));
  const double most_s = 1 / pose.rate_hz + Seconds(*pose.worst_latency);
  struct Late {
    std::uint64_t seed;
    bool up, down;
    std::size_t returns;
  };
  for (const Late& late : {Late{346, true, true, 7}, {354, true, false, 19}, {363, false, true, 11}}) {
    const FirstPoses dut = FirstPoseRun(late.seed, late.up, late.down, 1).Run(late.returns);
    EXPECT_GT(dut.worst_s(), 0.3) << late.seed;
    EXPECT_LE(dut.worst_s(), most_s) << late.seed;
    const auto shorter = static_cast<std::uint32_t>(health.bits) - 100;
    if (late.up) {
      EXPECT_LE(FirstPoseRun(late.seed, late.up, late.down, 1, shorter).Run(60).worst_s(), 0.3) << late.seed;
    }
  }
}

/// A stop holds the line until it is acknowledged. What the operator commands meanwhile is displaced, and
/// would move nothing: the base stands. Everything else is obeyed.
TEST(LinkMeasurements, AStopDisplacesNoMoreCommandsThanFallWithinItsAcknowledgement) {
  for (const auto& [up_s, down_s] : {std::pair{0.001, 0.001}, {0.05, 0.05}, {0.1, 0.0}, {0.0, 0.1}}) {
    const Obeyed dut =
        DriveRun({.up_s = up_s, .down_s = down_s, .jitter_s = 0.005, .stops_hz = 0.2, .seconds = 40}, 3)
            .Run();
    EXPECT_GE(dut.stops, 6U);
    EXPECT_GE(dut.share_without_stops(), 0.99) << up_s << ", " << down_s;
    EXPECT_LE(dut.longest_stop_s, 0.35) << up_s << ", " << down_s;
    EXPECT_LE(dut.most_displaced, 1 + static_cast<std::size_t>(std::ceil(dut.longest_stop_s / 0.05)));
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
