#include "bus/radio/line/line.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);

std::vector<std::byte> Bytes(std::size_t n, int value = 0x55) {
  return std::vector<std::byte>(n, static_cast<std::byte>(value));
}

Time After(double s) {
  return kStart + FromSeconds(s);
}

TEST(Line, AByteTakesTenBits) {
  Line dut({.baud = 9600, .latency_s = 0}, Rng(1), kStart);
  dut.Write(Bytes(960), kStart);
  EXPECT_EQ(dut.Read(After(0.5)).size(), 480U);
  EXPECT_EQ(dut.Read(After(1.0)).size(), 480U);
}

TEST(Line, WrittenTooEarlyWaitsLikeInATtyBuffer) {
  Line dut({.baud = 9600, .latency_s = 0}, Rng(1), kStart);
  dut.Write(Bytes(4096), kStart);
  EXPECT_NEAR(Seconds(dut.free_at() - kStart), 4.27, 0.01);
}

TEST(Line, ASlowerRadioSendsAtItsOwnRate) {
  Line dut({.baud = 9600, .air_rate_bytes_s = 240, .latency_s = 0}, Rng(1), kStart);
  dut.Write(Bytes(960), kStart);
  EXPECT_NEAR(static_cast<double>(dut.Read(After(1)).size()), 240, 2);
  EXPECT_NEAR(Seconds(dut.free_at() - kStart), 1, 0.01);
  EXPECT_NEAR(Seconds(dut.sent_at() - kStart), 4, 0.01);
}

TEST(Line, AHalfDuplexModemIsDeafWhileItSends) {
  LinePair dut({.baud = 9600, .latency_s = 0, .half_duplex = true, .turnaround_s = 0.1}, Rng(1), Rng(2),
               kStart);
  dut.a_to_b.Write(Bytes(96), kStart);       // 0.1 s
  dut.b_to_a.Write(Bytes(96), After(0.05));  // ends at 0.15 s, a can hear again at 0.2 s
  dut.b_to_a.Write(Bytes(96, 0x33), After(0.2));
  EXPECT_EQ(dut.b_to_a.Read(After(1)), Bytes(96, 0x33));
  EXPECT_NEAR(static_cast<double>(dut.a_to_b.Read(After(1)).size()), 48, 2);
}

TEST(Line, LatencyDelaysEveryByte) {
  Line dut({.baud = 9600, .latency_s = 0.1}, Rng(1), kStart);
  dut.Write(Bytes(1), kStart);
  EXPECT_TRUE(dut.Read(After(0.101)).empty());
  EXPECT_EQ(dut.Read(After(0.102)).size(), 1U);
}

/// When each of a number of bytes arrives that are written 0.1 s apart, in milliseconds after that.
std::vector<int> DelaysOf(const LineDelay& delay, int side, int bytes) {
  LineConfig config{.baud = 1'000'000, .latency_s = 0.01};
  config.delays = {delay};
  Line dut(config, Rng(1), kStart, nullptr, side);
  for (int i = 0; i < bytes; ++i) dut.Write(Bytes(1), After(0.1 * i));
  std::vector<int> delays;
  for (int ms = 0; ms < 5000; ++ms)
    for (std::size_t n = dut.Read(After(0.001 * ms)).size(); n > 0; --n)
      delays.push_back(ms - 100 * static_cast<int>(delays.size()) - 1);
  return delays;
}

TEST(Line, DelaysStepRampAndStall) {
  const std::vector<int> none{10, 10, 10, 10, 10, 10};
  EXPECT_EQ(DelaysOf({"both", 0.2, 0.4, 0.05, 0.05}, 0, 6), (std::vector<int>{10, 10, 60, 60, 10, 10}));
  EXPECT_EQ(DelaysOf({"both", 0.1, 0.5, 0, 0.04}, 0, 6), (std::vector<int>{10, 10, 20, 30, 40, 10}));
  // A stall: all come together when it ends, in their order.
  EXPECT_EQ(DelaysOf({"both", 0.15, 0.5, 0.3505, 0}, 0, 6), (std::vector<int>{10, 10, 310, 210, 110, 10}));
  EXPECT_EQ(DelaysOf({"a_to_b", 0, 9, 1, 1}, 1, 6), none);
  EXPECT_EQ(DelaysOf({"b_to_a", 0, 9, 1, 1}, 0, 6), none);
  EXPECT_EQ(DelaysOf({"b_to_a", 0, 9, 1, 1}, 1, 2), (std::vector<int>{1010, 1010}));
}

TEST(Line, JitterKeepsTheOrder) {
  Line dut({.baud = 9600, .latency_s = 0, .jitter_s = 0.05}, Rng(1), kStart);
  std::vector<std::byte> sent;
  for (int i = 0; i < 200; ++i) sent.push_back(static_cast<std::byte>(i));
  dut.Write(sent, kStart);
  EXPECT_EQ(dut.Read(After(1)), sent);
}

TEST(Line, NextArrivalIsWhenTheByteCanBeRead) {
  Line dut({.baud = 9600, .latency_s = 0.003}, Rng(1), kStart);
  EXPECT_EQ(dut.next_arrival(), Time::max());
  dut.Write(Bytes(1), kStart);
  const Time at = dut.next_arrival();
  EXPECT_TRUE(dut.Read(at - Duration(1)).empty());
  EXPECT_EQ(dut.Read(at).size(), 1U);
}

TEST(Line, BitErrorRateIsMet) {
  Line dut({.baud = 1000000, .latency_s = 0, .bit_error_rate = 1e-3}, Rng(3), kStart);
  const std::size_t n = 200000;
  dut.Write(Bytes(n), kStart);
  const auto received = dut.Read(After(10));
  const double lost = static_cast<double>(n - received.size()) / n;
  std::size_t changed = 0;
  for (const std::byte b : received) changed += b != std::byte{0x55} ? 1 : 0;
  EXPECT_NEAR(lost, 1e-3, 3e-4);  // start bits
  EXPECT_NEAR(static_cast<double>(changed) / n, 9e-3, 1e-3);
}

TEST(Line, CutLosesEverythingInside) {
  LineConfig config{.baud = 9600, .latency_s = 0};
  config.cuts = {{0.5, 0.75}};
  Line dut(config, Rng(1), kStart);
  dut.Write(Bytes(960), kStart);
  EXPECT_NEAR(static_cast<double>(dut.Read(After(1)).size()), 720, 1);
}

TEST(Line, BurstsAreRareAndDense) {
  LineConfig config{.baud = 9600, .latency_s = 0, .burst_rate_hz = 1, .burst_length_s = 0.02};
  Line dut(config, Rng(5), kStart);
  dut.Write(Bytes(96000), kStart);
  std::size_t changed = 0;
  const auto received = dut.Read(After(100));
  for (const std::byte b : received) changed += b != std::byte{0x55} ? 1 : 0;
  const double damaged = static_cast<double>(changed + 96000 - received.size());
  EXPECT_NEAR(damaged / (100 * 0.02 * 960), 0.97, 0.35);  // about 100 bursts of 19 bytes, nearly all hit
}

TEST(Line, DuplicatesBytes) {
  Line dut({.baud = 9600, .latency_s = 0, .duplicate_probability = 0.1}, Rng(1), kStart);
  dut.Write(Bytes(10000), kStart);
  EXPECT_NEAR(static_cast<double>(dut.Read(After(20)).size()), 11000, 150);
}

TEST(Line, SameSeedSameBytes) {
  const LineConfig config{.baud = 9600, .jitter_s = 0.01, .bit_error_rate = 1e-2};
  Line a(config, Rng(7), kStart), b(config, Rng(7), kStart);
  a.Write(Bytes(1000), kStart);
  b.Write(Bytes(1000), kStart);
  EXPECT_EQ(a.Read(After(0.4)), b.Read(After(0.4)));
  EXPECT_EQ(a.Read(After(2)), b.Read(After(2)));
}

}  // namespace
}  // namespace priamos::bus::radio
