#include "bus/radio/frame/coded_block.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "bus/radio/line/line.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

std::vector<std::byte> RandomContent(Rng& rng) {
  std::vector<std::byte> content(BlockBytes(1 + rng.Below(kMaxBlockBytes)));
  for (std::byte& b : content) b = static_cast<std::byte>(rng.Below(256));
  return content;
}

/// What a finder finds in bytes that come one per millisecond.
std::vector<BlockFinder::Found> Find(const std::vector<std::byte>& bytes) {
  BlockFinder dut;
  std::vector<BlockFinder::Found> found;
  Time now = FromUtime(1'000'000);
  for (const std::byte b : bytes) {
    if (auto block = dut.Push(b, now)) found.push_back(std::move(*block));
    now += Duration(1000);
  }
  return found;
}

std::vector<std::byte> Delimited(std::vector<std::byte> encoded) {
  encoded.push_back(std::byte{0});
  return encoded;
}

TEST(CodedBlock, SizesOfItsContents) {
  EXPECT_EQ(BlockBytes(1), 11U);
  EXPECT_EQ(BlockBytes(11), 11U);
  EXPECT_EQ(BlockBytes(12), 14U);
  EXPECT_EQ(BlockBytes(29), kMaxBlockBytes);
  EXPECT_EQ(BlockBytes(35), 0U);
  EXPECT_EQ(EncodedBlockBytes(11), 21U);
  EXPECT_EQ(EncodedBlockBytes(34), 47U);
}

RC_GTEST_PROP(CodedBlock, HasTheLengthThatItsContentSaysAndNoDelimiter, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto content = RandomContent(rng);
  const auto encoded = EncodeBlock(content);
  RC_ASSERT(encoded.size() == EncodedBlockBytes(content.size()));
  for (const std::byte b : encoded) RC_ASSERT((b & std::byte{0x80}) != std::byte{0});
  RC_ASSERT(DecodeBlock(encoded) == content);
}

RC_GTEST_PROP(CodedBlock, SurvivesFourWrongBytes, (std::uint64_t seed)) {
  Rng rng(seed);
  const auto content = RandomContent(rng);
  auto encoded = EncodeBlock(content);
  for (int i = 0; i < 4; ++i) {
    // A stop bit that is damaged gives a 0, a data bit another byte.
    std::byte& b = encoded[rng.Below(encoded.size())];
    b = rng.Chance(0.2) ? std::byte{0} : b ^ static_cast<std::byte>(1 + rng.Below(255));
  }
  RC_ASSERT(DecodeBlock(encoded) == content);
}

TEST(CodedBlock, SurvivesALostByteAndThreeWrongOnesButForOneInAThousand) {
  int lost = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    Rng rng(seed);
    const auto content = RandomContent(rng);
    auto encoded = EncodeBlock(content);
    for (int i = 0; i < 3; ++i)
      encoded[rng.Below(encoded.size())] ^= static_cast<std::byte>(1 + rng.Below(255));
    encoded.erase(encoded.begin() + static_cast<std::ptrdiff_t>(rng.Below(encoded.size())));
    if (DecodeBlock(encoded) != content) ++lost;
  }
  EXPECT_LE(lost, 10);
}

TEST(CodedBlock, OfAnyOtherLengthIsNone) {
  const std::vector<std::byte> encoded = EncodeBlock(std::vector<std::byte>(14));
  for (const std::size_t bytes : {0U, 1U, 12U, 19U, 22U})
    EXPECT_FALSE(DecodeBlock(std::span(encoded).first(bytes))) << bytes;
}

TEST(BlockFinder, FindsABlockBetweenFrames) {
  const std::vector<std::byte> content(11, std::byte{7});
  std::vector<std::byte> bytes = Delimited(Text("another frame"));
  const std::size_t first = bytes.size();
  for (const std::byte b : Delimited(EncodeBlock(content))) bytes.push_back(b);
  const auto found = Find(bytes);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].content, content);
  EXPECT_EQ(found[0].wire_bytes, 22U);
  EXPECT_EQ(ToUtime(found[0].first_byte), 1'000'000 + 1000 * static_cast<std::int64_t>(first));
}

TEST(BlockFinder, FindsABlockBehindAFrameWhoseDelimiterWasLost) {
  std::vector<std::byte> bytes = Text("a frame without its end");
  for (const std::byte b : Delimited(EncodeBlock(std::vector<std::byte>(17)))) bytes.push_back(b);
  EXPECT_EQ(Find(bytes).size(), 1U);
}

TEST(BlockFinder, FindsABlockWhoseDelimiterIsDamagedOrLost) {
  std::vector<std::byte> bytes = Delimited(EncodeBlock(std::vector<std::byte>(17)));
  bytes.back() = std::byte{4};
  EXPECT_EQ(Find(bytes).size(), 1U);
  bytes.pop_back();
  for (const std::byte b : Delimited(EncodeBlock(std::vector<std::byte>(17)))) bytes.push_back(b);
  EXPECT_EQ(Find(bytes).size(), 2U);
}

TEST(BlockFinder, FindsABlockInWhichDamageLooksLikeADelimiter) {
  auto encoded = EncodeBlock(std::vector<std::byte>(17, std::byte{0x55}));
  encoded[5] = encoded[11] = std::byte{0};
  const auto found = Find(Delimited(encoded));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].content, std::vector<std::byte>(17, std::byte{0x55}));
}

TEST(BlockFinder, FindsNothingInIdleLineNorInFrames) {
  EXPECT_TRUE(Find(std::vector<std::byte>(200)).empty());
  Rng rng(3);
  std::vector<std::byte> bytes(200'000);
  for (std::byte& b : bytes) b = static_cast<std::byte>(rng.Below(128));
  EXPECT_TRUE(Find(bytes).empty());
}

/// Share of blocks that a line delivers which flips bits at this rate.
double Delivered(double bit_error_rate) {
  LineConfig config{.latency_s = 0};
  config.bit_error_rate = bit_error_rate;
  Line line(config, Rng::Stream(1, "block"), Time{});
  BlockFinder dut;
  const std::vector<std::byte> content(11, std::byte{0x5A});
  const auto wire = Delimited(EncodeBlock(content));
  int found = 0;
  constexpr int kBlocks = 2000;
  for (int i = 0; i < kBlocks; ++i) {
    const Time now = line.free_at() + FromSeconds(0.1);
    line.Write(wire, now);
    for (const std::byte b : line.Read(now + FromSeconds(0.1)))
      if (const auto block = dut.Push(b, now)) found += block->content == content ? 1 : 0;
  }
  return found / double{kBlocks};
}

TEST(BlockFinder, FindsWhatALineHasDamaged) {
  EXPECT_EQ(Delivered(0), 1);
  EXPECT_GE(Delivered(1e-3), 0.995);
  EXPECT_GE(Delivered(3e-3), 0.98);
  EXPECT_GE(Delivered(1e-2), 0.87);
}

}  // namespace
}  // namespace priamos::bus::radio
