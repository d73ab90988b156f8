#include <gtest/gtest.h>

#include <algorithm>

#include "bus/radio/budget.hpp"
#include "packet_world.hpp"

namespace priamos::bus::radio {
namespace {

class PacketRadioTest : public testing::TestWithParam<PacketRadio> {};

void ExpectPromisesKept(const PacketWorld& world) {
  EXPECT_EQ(world.refused, 0U);
  EXPECT_EQ(world.torn, 0U);
  EXPECT_EQ(world.disordered, 0U);
  EXPECT_EQ(world.late, 0U);
}

TEST_P(PacketRadioTest, NoMessageIsLaterThanItsBound) {
  PacketWorld dut(GetParam(), 0, 7);
  dut.Run(20, false);
  const std::size_t collisions = dut.collisions();
  dut.Run(GetParam().hours * 3600, true);
  dut.Run(60, false);
  const Budget budget = ComputeBudget(ChannelTable(dut.channels(), false), GetParam().options);
  ASSERT_TRUE(budget.problems.empty()) << budget.problems.front();
  for (const DirectionBudget* d : {&budget.up, &budget.down}) {
    EXPECT_LE(dut.longest_packet, GetParam().options.packet_bytes);
    for (const ChannelBudget& row : d->channels) {
      ASSERT_TRUE(row.worst_latency) << dut.channels()[row.channel].name;
      EXPECT_GT(dut.received[row.channel], 100U);
      EXPECT_EQ(dut.received[row.channel], dut.offered[row.channel]);
      EXPECT_LE(Seconds(std::ranges::max(dut.latencies[row.channel])), Seconds(*row.worst_latency) + 0.002)
          << dut.channels()[row.channel].name;
    }
  }
  ExpectPromisesKept(dut);
  EXPECT_EQ(dut.overlaps, 0U);
  EXPECT_EQ(dut.collisions(), collisions);
  if (GetParam().options.duty.limited()) {
    EXPECT_LE(dut.LargestShare(FromSeconds(600)), 0.1);
  }
}

TEST_P(PacketRadioTest, EventsComeExactlyOnceWhereOnePacketInFiveIsLost) {
  PacketWorld dut(GetParam(), 0.2, 11);
  dut.Run(std::max(600.0, 30 * GetParam().unit_s), true);
  dut.Run(300, false);
  ExpectPromisesKept(dut);
  for (std::size_t i = 0; i < dut.channels().size(); ++i)
    if (dut.channels()[i].channel_class == ChannelClass::kEvent) {
      EXPECT_GT(dut.received[i], 10U);
      EXPECT_EQ(dut.received[i], dut.offered[i]) << dut.channels()[i].name;
    }
}

INSTANTIATE_TEST_SUITE_P(Radios, PacketRadioTest, testing::ValuesIn(PacketRadios()),
                         [](const auto& radio) { return radio.param.name; });

/// An operator who hits the stop again and again, and nobody who answers: the law holds all the same.
TEST(PacketRadioDuty, HoldsHoweverManyStopsWait) {
  PacketWorld dut(DutyCycleRadio(), 0.9, 3);
  for (int i = 0; i < 20; ++i) {
    dut.Run(60, true);
    dut.Run(60, false);
  }
  EXPECT_GT(dut.LargestShare(FromSeconds(600)), 0.05) << "nothing was tried";
  EXPECT_LE(dut.LargestShare(FromSeconds(600)), 0.1);
}

TEST(PacketBudget, RefusesWhatTheDutyCycleCannotCarry) {
  LinkOptions options = DutyCycleRadio().options;
  const auto problem_of = [&] {
    const Budget budget =
        ComputeBudget(ChannelTable(PacketChannels(60, Duration(20'000'000)), false), options);
    return budget.problems.empty() ? "" : budget.problems.front();
  };
  EXPECT_EQ(problem_of(), "");
  options.duty = DutyCycle(0.1, FromSeconds(10));
  EXPECT_NE(problem_of().find("duty_cycle: expected packets of at most"), std::string::npos) << problem_of();
  options.duty = DutyCycle(0.1, FromSeconds(24));
  EXPECT_NE(problem_of().find("expected urgent messages that take at most"), std::string::npos)
      << problem_of();
  options = DutyCycleRadio().options;
  options.silence = Duration(1'000'000);
  EXPECT_NE(problem_of().find("silence_s: radio link up: expected at least"), std::string::npos)
      << problem_of();
  options = DutyCycleRadio().options;
  options.duty = DutyCycle(0.01, FromSeconds(6000));
  EXPECT_NE(problem_of(), "") << "a tenth of the air for the same messages";
}

TEST(PacketBudget, RefusesAFrameThatNoPacketHolds) {
  LinkOptions options = PacketRadios().front().options;
  options.packet_bytes = 100;
  const Budget budget = ComputeBudget(ChannelTable(PacketChannels(20, Duration(3'000'000)), false), options);
  ASSERT_FALSE(budget.problems.empty());
  EXPECT_NE(budget.problems.front().find("expected frames of at most 100 byte, the mtu_bytes"),
            std::string::npos)
      << budget.problems.front();
}

}  // namespace
}  // namespace priamos::bus::radio
