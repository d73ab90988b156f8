#include "bus/radio/station.hpp"

#include <gtest/gtest.h>

#include <map>

#include "bus/radio/budget.hpp"
#include "bus/radio/frame/cobs.hpp"
#include "test/bus/radio/shared/shared_traffic.hpp"

namespace priamos::bus::radio {
namespace {

std::size_t Count(const std::vector<SharedWorld::Received>& received, std::size_t robot,
                  std::size_t channel) {
  return static_cast<std::size_t>(std::count_if(received.begin(), received.end(), [&](const auto& r) {
    return r.robot == robot && r.delivery.channel == channel;
  }));
}

TEST(Station, EveryRobotAgreesAndSendsItsPose) {
  SharedWorld dut(4);
  dut.Run(5);
  dut.up.clear();
  std::uint64_t number = 0;
  dut.Run(20, [&] {
    if (ToUtime(dut.now) % 200'000 == 0)
      for (std::size_t i = 0; i < 4; ++i) dut.robot(i)->Offer(kSharedPose, Numbered(17, ++number), dut.now);
  });
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GE(Count(dut.up, i, kSharedPose), 20U) << i;
}

TEST(Station, WhatIsForOneRobotReachesNoOther) {
  SharedWorld dut(3);
  dut.Run(5);
  dut.at_station(1).Offer(kSharedStop, Numbered(2, 7), dut.now);
  dut.Run(2);
  EXPECT_EQ(Count(dut.down, 0, kSharedStop), 0U);
  ASSERT_EQ(Count(dut.down, 1, kSharedStop), 1U);
  EXPECT_EQ(Count(dut.down, 2, kSharedStop), 0U);
  EXPECT_EQ(dut.at_station(1).waiting(kSharedStop), 0U);  // and it is acknowledged
}

/// Nothing may take longer than the budget says, on a line that takes 1 ms.
void ExpectWithinBounds(SharedTraffic& traffic, const Budget& budget) {
  const Duration line(1'000);
  for (const DirectionBudget* d : {&budget.up, &budget.down}) {
    for (const ChannelBudget& row : d->channels) {
      ASSERT_TRUE(row.worst_latency) << row.channel;
      if (row.channel == kSharedStop) continue;
      for (const Duration took : traffic.of(row.channel).latencies)
        ASSERT_LE(took, *row.worst_latency + line) << row.channel;
    }
  }
  for (const Duration took : traffic.of(kSharedStop).latencies) ASSERT_LE(took, budget.polls.urgent_one);
  for (const Duration took : traffic.of(SharedTraffic::kStopToAll).latencies)
    ASSERT_LE(took, budget.polls.urgent_all);
}

TEST(Station, NothingTakesLongerThanItsBound) {
  SharedWorld world(4, 11);
  const Budget budget = ComputeBudget(ChannelTable(SharedTestChannels(), false), world.options);
  ASSERT_TRUE(budget.problems.empty()) << budget.problems.front();
  world.Run(5);
  SharedTraffic dut(world, 4, 11);
  dut.Run(300);
  ExpectWithinBounds(dut, budget);
  for (const std::size_t kind : {std::size_t{kSharedFault}, std::size_t{kSharedStop},
                                 std::size_t{kSharedOrder}, SharedTraffic::kStopToAll}) {
    EXPECT_EQ(dut.of(kind).latencies.size(), dut.of(kind).offered) << kind;
    EXPECT_GT(dut.of(kind).offered, 0U) << kind;
  }
  EXPECT_GE(dut.of(kSharedPose).latencies.size(), dut.of(kSharedPose).offered * 99 / 100);
}

TEST(Station, EachOfFourRobotsHasAPoseEverySecondBesideStopsAndDriving) {
  constexpr double kSeconds = 60;
  SharedWorld world(4, 8);
  world.Run(5);
  SharedTraffic traffic(world, 4, 8);
  traffic.KeepPosesComing();
  traffic.Run(kSeconds, 0);
  // None has more than its rate, so that each has nearly as many as that.
  EXPECT_GE(traffic.of(kSharedPose).latencies.size(), 4 * static_cast<std::size_t>(kSeconds - 1));
}

TEST(Station, OnABadLineEventsComeOnceAndNoCommandLate) {
  SharedWorld world(4, 12, {.latency_s = 0.001, .bit_error_rate = 1e-3});
  world.Run(10);
  SharedTraffic dut(world, 4, 12);
  dut.Run(300, 60);
  EXPECT_EQ(dut.of(kSharedDrive).late, 0U);
  EXPECT_GT(dut.of(kSharedDrive).latencies.size(), 500U);
  for (const std::size_t kind : {std::size_t{kSharedFault}, std::size_t{kSharedStop},
                                 std::size_t{kSharedOrder}, SharedTraffic::kStopToAll}) {
    EXPECT_EQ(dut.of(kind).latencies.size(), dut.of(kind).offered) << kind;
    EXPECT_EQ(dut.of(kind).repeated + dut.of(kind).disordered, 0U) << kind;
  }
}

TEST(Station, AbsentRobotsDelayTheOthersLessThanPresentOnesAndComeBack) {
  SharedWorld dut(4, 13);
  dut.Run(5);
  dut.StopRobot(2);
  dut.at_station(2).Offer(kSharedStop, Numbered(2, 1), dut.now);  // which nobody acknowledges
  dut.Run(20);
  dut.up.clear();
  std::uint64_t number = 0;
  dut.Run(10, [&] {
    if (ToUtime(dut.now) % 100'000 == 0) dut.robot(0)->Offer(kSharedPose, Numbered(17, ++number), dut.now);
  });
  EXPECT_GE(Count(dut.up, 0, kSharedPose), 10U);
  dut.StartRobot(2);
  dut.Run(8);
  EXPECT_EQ(Count(dut.down, 2, kSharedStop), 1U);
}

TEST(Station, ARobotThatLostItsMemoryComesBack) {
  SharedWorld dut(2, 14);
  dut.Run(5);
  dut.at_station(1).Offer(kSharedStop, Numbered(2, 1), dut.now);
  dut.StopRobot(1);
  dut.StoreOf(1) = {};
  dut.Run(3);
  dut.StartRobot(1);
  dut.Run(15);
  EXPECT_TRUE(dut.robot(1)->Status(dut.now).up);
  EXPECT_EQ(dut.at_station(1).waiting(kSharedStop), 0U);
  EXPECT_LE(Count(dut.down, 1, kSharedStop), 1U);
}

TEST(Station, AStopReachesARobotThatWasStartedAgainWithinThreeSeconds) {
  for (const bool remembers : {true, false}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SharedWorld dut(4, seed);
      dut.Run(6);
      dut.StopRobot(2);
      dut.Run(0.4 * static_cast<double>(seed));
      if (!remembers) dut.StoreOf(2).Lose();
      dut.StartRobot(2);
      dut.down.clear();
      dut.at_station(2).Offer(kSharedStop, std::vector<std::byte>(2, std::byte{1}), dut.now);
      dut.Run(3);
      const bool came = std::any_of(dut.down.begin(), dut.down.end(), [](const SharedWorld::Received& r) {
        return r.robot == 2 && r.delivery.channel == kSharedStop;
      });
      EXPECT_TRUE(came) << remembers << " " << seed;
    }
  }
}

/// Robots that do not answer have stops that wait: those to others are not held back by their repetitions.
TEST(Station, ANewStopGoesBeforeTheRepetitionsToAbsentRobots) {
  SharedWorld dut(8, 3);
  dut.Run(6);
  for (std::size_t i = 0; i < 7; ++i) dut.StopRobot(i);
  const double bound_s =
      Seconds(PollBoundsOf(ChannelTable(SharedTestChannels(), false), dut.options).urgent_one);
  for (int n = 0; n < 20; ++n) {
    for (std::size_t i = 0; i < 7; ++i)
      dut.at_station(i).Offer(kSharedStop, std::vector<std::byte>(2, std::byte{1}), dut.now);
    dut.Run(0.31 + 0.01 * n);
    dut.down.clear();
    const Time offered = dut.now;
    dut.at_station(7).Offer(kSharedStop, std::vector<std::byte>(2, std::byte{1}), dut.now);
    dut.Run(1);
    ASSERT_FALSE(dut.down.empty());
    EXPECT_LE(Seconds(dut.down.front().at - offered), bound_s + 0.02) << n;
  }
}

TEST(Station, ARobotWithTheKeyOfAnotherTakesNoneOfItsFrames) {
  const LinkKey key{1};
  const FrameScope scope_1{.table_hash = 7, .address = 1}, scope_2{.table_hash = 7, .address = 2};
  FrameOpener opener(FrameKeys(key), Direction::kDown, scope_2);
  opener.SetEpoch(5, 0);
  FrameSealer sealer(FrameKeys(key), Direction::kDown, scope_1);
  std::vector<std::byte> wire = sealer.Seal(5, 1, CounterForm::kLowBits, Text("bundle"));
  wire.pop_back();
  std::vector<std::byte> content = *CobsDecode(wire);
  EXPECT_FALSE(opener.Addressed(content));
  content[0] = std::byte{2};  // on the line anybody can write another address
  ASSERT_TRUE(opener.Addressed(content));
  EXPECT_EQ(std::get<Reject>(opener.Open(std::span(content).subspan(1))), Reject::kBadCode);
}

}  // namespace
}  // namespace priamos::bus::radio
