#include "bus/schema/bit_stream.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "encoding.hpp"

namespace priamos::bus {
namespace {

Bytes BytesOf(std::initializer_list<int> values) {
  Bytes bytes;
  for (const int v : values) bytes.push_back(static_cast<std::byte>(v));
  return bytes;
}

TEST(BitStream, WritesTheMostSignificantBitFirstAndFillsWithZeros) {
  BitWriter dut;
  dut.Put(0b101, 3);
  dut.Put(0b1, 1);
  dut.Put(0xABC, 12);
  dut.Put(1, 2);
  EXPECT_EQ(dut.Finish(), BytesOf({0xBA, 0xBC, 0x40}));
}

TEST(BitStream, WritesNothingForNoBits) {
  BitWriter dut;
  dut.Put(0, 0);
  EXPECT_TRUE(dut.Finish().empty());
}

TEST(BitStream, ReadingOverTheEndIsNotOk) {
  const Bytes bytes = BytesOf({0xFF});
  BitReader dut(bytes);
  EXPECT_EQ(dut.Get(8), 0xFFu);
  EXPECT_TRUE(dut.ok());
  EXPECT_EQ(dut.Get(1), 0u);
  EXPECT_FALSE(dut.ok());
}

TEST(BitStream, SeesWhatIsLeftOfTheLastByte) {
  const Bytes bytes = BytesOf({0b10100000, 0b00000001});
  BitReader dut(bytes);
  dut.Get(3);
  EXPECT_TRUE(dut.FillIsZero());
  EXPECT_EQ(dut.bytes_used(), 1u);
  dut.Get(9);
  EXPECT_FALSE(dut.FillIsZero());
  EXPECT_EQ(dut.bytes_used(), 2u);
}

TEST(BitStream, BitsAboveTheWidthAreLeftOut) {
  BitWriter dut;
  dut.Put(~std::uint64_t{0}, 3);
  dut.Put(0, 2);
  EXPECT_EQ(dut.Finish(), BytesOf({0xE0}));
}

TEST(BitStream, BytesSoFarAreACopy) {
  BitWriter dut;
  dut.Put(1, 1);
  EXPECT_EQ(dut.bytes(), BytesOf({0x80}));
  dut.Put(0xFF, 8);
  EXPECT_EQ(dut.bits(), 9u);
  EXPECT_EQ(dut.bytes(), BytesOf({0xFF, 0x80}));
}

TEST(BitStream, AppendedBitsComeBackAtAnyOffset) {
  const Bytes body = BytesOf({0xA5, 0xC0});
  for (int offset = 0; offset < 9; ++offset) {
    BitWriter out;
    out.Put(1, offset);
    out.Append(body, 10);
    out.Put(1, 1);
    const Bytes bytes = out.Finish();
    BitReader dut(bytes);
    EXPECT_EQ(dut.Get(offset), offset == 0 ? 0u : 1u);
    EXPECT_EQ(dut.Take(10), body);
    EXPECT_EQ(dut.Get(1), 1u);
    EXPECT_EQ(dut.left(), bytes.size() * 8 - static_cast<std::size_t>(offset) - 11);
  }
}

TEST(BitStream, MoreThanIsLeftIsNotTaken) {
  const Bytes bytes = BytesOf({0xFF});
  BitReader dut(bytes);
  EXPECT_TRUE(dut.Take(1000000000).empty());
  EXPECT_FALSE(dut.ok());
}

TEST(BitStream, BitsForCodes) {
  EXPECT_EQ(BitsFor(0), 0);
  EXPECT_EQ(BitsFor(1), 1);
  EXPECT_EQ(BitsFor(255), 8);
  EXPECT_EQ(BitsFor(256), 9);
  EXPECT_EQ(BitsFor(~std::uint64_t{0}), 64);
}

TEST(BitStream, WhatIsWrittenIsRead) {
  EXPECT_TRUE(rc::check([](const std::vector<std::pair<std::uint64_t, std::uint8_t>>& numbers) {
    BitWriter writer;
    std::vector<std::uint64_t> written;
    for (const auto& [value, width] : numbers) {
      const int bits = width % 65;
      written.push_back(bits == 64 ? value : value & ((std::uint64_t{1} << bits) - 1));
      writer.Put(written.back(), bits);
    }
    const Bytes bytes = writer.Finish();
    BitReader reader(bytes);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      RC_ASSERT(reader.Get(numbers[i].second % 65) == written[i]);
    RC_ASSERT(reader.ok() && reader.FillIsZero() && reader.bytes_used() == bytes.size());
  }));
}

}  // namespace
}  // namespace priamos::bus
