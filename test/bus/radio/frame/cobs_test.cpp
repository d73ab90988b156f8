#include "bus/radio/frame/cobs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "test/support/radio/bytes.hpp"

namespace priamos::bus::radio {
namespace {

using support::Bytes;

TEST(Cobs, ExamplesOfThePublication) {
  EXPECT_EQ(CobsEncode(Bytes({})), Bytes({1}));
  EXPECT_EQ(CobsEncode(Bytes({0})), Bytes({1, 1}));
  EXPECT_EQ(CobsEncode(Bytes({0x11, 0x22, 0, 0x33})), Bytes({3, 0x11, 0x22, 2, 0x33}));
}

TEST(Cobs, OneByteOfOverheadUpTo254) {
  EXPECT_EQ(CobsEncode(std::vector<std::byte>(254, std::byte{7})).size(), 255U);
  EXPECT_EQ(CobsEncode(std::vector<std::byte>(255, std::byte{7})).size(), 257U);
}

RC_GTEST_PROP(Cobs, RoundTripWithoutZeros, (const std::vector<std::uint8_t>& values)) {
  std::vector<std::byte> content;
  for (const std::uint8_t v : values) content.push_back(static_cast<std::byte>(v % 5 == 0 ? 0 : v));
  const auto encoded = CobsEncode(content);
  RC_ASSERT(std::count(encoded.begin(), encoded.end(), std::byte{0}) == 0);
  RC_ASSERT(CobsDecode(encoded) == content);
}

TEST(Cobs, CutShortIsRefused) {
  const auto encoded = CobsEncode(Bytes({1, 2, 3, 4}));
  for (std::size_t n = 1; n < encoded.size(); ++n) EXPECT_FALSE(CobsDecode(std::span(encoded).first(n))) << n;
}

TEST(Cobs, AZeroInsideIsRefused) {
  EXPECT_FALSE(CobsDecode(Bytes({3, 1, 0})));
}

TEST(FrameSplitter, ResynchronisesAtTheNextDelimiter) {
  FrameSplitter dut(8);
  for (const int b : {9, 9, 9}) EXPECT_EQ(dut.Push(static_cast<std::byte>(b)), FrameSplitter::Event::kNone);
  EXPECT_EQ(dut.Push(std::byte{0}), FrameSplitter::Event::kFrame);
  EXPECT_EQ(dut.Push(std::byte{5}), FrameSplitter::Event::kNone);
  EXPECT_EQ(dut.Push(std::byte{0}), FrameSplitter::Event::kFrame);
  EXPECT_EQ(std::vector(dut.frame().begin(), dut.frame().end()), Bytes({5}));
}

TEST(FrameSplitter, OversizeIsThrownAwayWhole) {
  FrameSplitter dut(8);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(dut.Push(std::byte{1}), FrameSplitter::Event::kNone);
  EXPECT_EQ(dut.Push(std::byte{0}), FrameSplitter::Event::kOversize);
  dut.Push(std::byte{2});
  EXPECT_EQ(dut.Push(std::byte{0}), FrameSplitter::Event::kFrame);
  EXPECT_EQ(dut.frame().size(), 1U);
}

TEST(FrameSplitter, RepeatedDelimitersAreNoFrames) {
  FrameSplitter dut(8);
  EXPECT_EQ(dut.Push(std::byte{0}), FrameSplitter::Event::kNone);
  EXPECT_EQ(dut.Push(std::byte{0}), FrameSplitter::Event::kNone);
}

}  // namespace
}  // namespace priamos::bus::radio
