#include "bus/wire/sequence_tracker.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

constexpr std::uint64_t kA = 1, kB = 2;

TEST(SequenceTracker, NumbersInOrderAreNoLoss) {
  SequenceTracker dut;
  for (std::uint32_t i = 100; i < 200; ++i) dut.Add(kA, i);
  EXPECT_EQ(dut.lost(), 0u);
}

TEST(SequenceTracker, GapsAreLosses) {
  SequenceTracker dut;
  for (const std::uint32_t n : {5u, 6u, 9u, 10u, 20u}) dut.Add(kA, n);
  EXPECT_EQ(dut.lost(), 2u + 9u);
}

TEST(SequenceTracker, SendersAreCountedEachForItself) {
  SequenceTracker dut;
  for (std::uint32_t i = 0; i < 50; ++i) {
    dut.Add(kA, i);
    dut.Add(kB, 1000 + 2 * i);
  }
  EXPECT_EQ(dut.lost(), 49u);
  EXPECT_EQ(dut.senders(), 2u);
}

TEST(SequenceTracker, NumbersRunThroughTheirEnd) {
  SequenceTracker dut;
  for (const std::uint32_t n : {0xfffffffeu, 0xffffffffu, 0u, 2u}) dut.Add(kA, n);
  EXPECT_EQ(dut.lost(), 1u);
}

TEST(SequenceTracker, OneThatComesLateIsNotLost) {
  SequenceTracker dut;
  for (const std::uint32_t n : {1u, 2u, 4u, 3u, 5u}) dut.Add(kA, n);
  EXPECT_EQ(dut.lost(), 0u);
}

TEST(SequenceTracker, ASenderThatBeginsAnewLosesNothing) {
  SequenceTracker dut;
  for (const std::uint32_t n : {70'000u, 70'001u, 0u, 1u, 3'000'000'000u, 3'000'000'001u}) dut.Add(kA, n);
  EXPECT_EQ(dut.lost(), 0u);
}

TEST(SequenceTracker, ADuplicateTakesNoOtherLossBack) {
  SequenceTracker dut;
  for (const std::uint32_t n : {1u, 2u, 2u, 2u, 3u}) dut.Add(kA, n);
  EXPECT_EQ(dut.lost(), 0u);
}

TEST(SequenceTracker, AFloodOfSendersIsBounded) {
  SequenceTracker dut;
  for (std::uint64_t sender = 0; sender < 100'000; ++sender) {
    dut.Add(kA, static_cast<std::uint32_t>(2 * sender));
    dut.Add(1000 + sender, 7);
  }
  EXPECT_EQ(dut.senders(), SequenceTracker::kMostSenders);
  EXPECT_EQ(dut.lost(), 99'999u);  // the busy one was not forgotten
}

}  // namespace
}  // namespace priamos::bus
