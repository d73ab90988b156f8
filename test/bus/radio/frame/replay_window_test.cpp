#include "bus/radio/frame/replay_window.hpp"

#include <gtest/gtest.h>

namespace priamos::bus::radio {
namespace {

TEST(ReplayWindow, EachCounterOnce) {
  ReplayWindow dut;
  for (const std::uint64_t c : {1U, 5U, 3U, 200U}) {
    EXPECT_TRUE(dut.Fresh(c));
    dut.Use(c);
    EXPECT_FALSE(dut.Fresh(c));
  }
  EXPECT_TRUE(dut.Fresh(199));
}

TEST(ReplayWindow, NothingUpToTheFloor) {
  const ReplayWindow dut(1000);
  for (std::uint64_t c = 0; c <= 1000; ++c) EXPECT_FALSE(dut.Fresh(c)) << c;
  EXPECT_TRUE(dut.Fresh(1001));
}

TEST(ReplayWindow, OlderThanTheWindowIsNeverFresh) {
  ReplayWindow dut;
  dut.Use(100);
  EXPECT_TRUE(dut.Fresh(37));
  EXPECT_FALSE(dut.Fresh(36));
}

TEST(ReplayWindow, ReconstructsFromSevenBits) {
  for (const std::uint64_t highest : {0ULL, 5ULL, 31ULL, 100ULL, 127ULL, 128ULL, 1000000ULL}) {
    const ReplayWindow dut(highest);
    const std::uint64_t first = highest < 31 ? 0 : highest - 31;
    for (std::uint64_t c = first; c < first + 128; ++c)
      EXPECT_EQ(dut.Reconstruct(static_cast<std::uint8_t>(c & 0x7F)), c);
  }
}

}  // namespace
}  // namespace priamos::bus::radio
