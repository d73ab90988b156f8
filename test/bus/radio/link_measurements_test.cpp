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

/// Whatever the blackout cuts, beside all other channels at their rates with their largest messages. The last
/// three were late before POSE had its bound: 0.31 to 0.34 s.
TEST(LinkMeasurements, AFreshPoseIsThereSoonAfterAnyBlackout) {
  struct Case {
    std::uint64_t seed;
    bool up, down;
    std::size_t returns;
  };
  for (const Case& c : {Case{5, true, true, 100},
                        {5, true, false, 100},
                        {5, false, true, 100},
                        {346, true, true, 7},
                        {354, true, false, 19},
                        {363, false, true, 11}})
    EXPECT_LE(FirstPoseRun(c.seed, c.up, c.down, 1).Run(c.returns).worst_s(), 0.3) << c.seed;
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

/// 0.3 s with the 20 ms between two poses of the robot; each emergency stop adds its acknowledgement.
TEST(LinkMeasurements, TheBudgetProvesThatPosesStayFresh) {
  const ChannelBudget pose = BudgetOf("POSE");
  ASSERT_TRUE(pose.fresh && pose.fresh->beside_urgent);
  EXPECT_LE(pose.fresh->least, FromSeconds(0.28));
  EXPECT_LE(*pose.fresh->beside_urgent, FromSeconds(0.32));
  EXPECT_EQ(*pose.worst_latency, *pose.fresh->beside_urgent);
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
