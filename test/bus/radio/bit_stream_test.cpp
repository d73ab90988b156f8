#include "bus/radio/bit_stream.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <utility>
#include <vector>

namespace priamos::bus::radio {
namespace {

TEST(BitStream, MostSignificantBitFirst) {
  BitWriter dut;
  dut.Write(0b101, 3);
  dut.Write(0x1F, 5);
  dut.Write(1, 1);
  EXPECT_EQ(dut.bytes(), (std::vector{std::byte{0xBF}, std::byte{0x80}}));
  EXPECT_EQ(dut.bits(), 9U);
}

RC_GTEST_PROP(BitStream, RoundTrip, (const std::vector<std::pair<std::uint64_t, std::uint8_t>>& values)) {
  BitWriter out;
  for (const auto& [value, width] : values) out.Write(value, width % 65);
  BitReader in(out.bytes());
  for (const auto& [value, width] : values) {
    const int bits = width % 65;
    RC_ASSERT(in.Read(bits) == (bits == 64 ? value : value & ((std::uint64_t{1} << bits) - 1)));
  }
  RC_ASSERT(in.ok());
}

TEST(BitStream, AppendedBitsComeBackAtAnyOffset) {
  const std::vector body{std::byte{0xA5}, std::byte{0xC0}};
  BitWriter out;
  out.Write(1, 3);
  out.Append(body, 10);
  out.Write(1, 1);
  BitReader in(out.bytes());
  EXPECT_EQ(in.Read(3), 1U);
  EXPECT_EQ(in.Take(10), body);
  EXPECT_EQ(in.Read(1), 1U);
}

TEST(BitStream, ReadingPastTheEndIsNoticed) {
  const std::vector body{std::byte{0xFF}};
  BitReader dut(body);
  EXPECT_EQ(dut.Read(9), 0x1FEU);
  EXPECT_FALSE(dut.ok());
  EXPECT_TRUE(dut.Take(1000000000).empty());
}

}  // namespace
}  // namespace priamos::bus::radio
