#include "bus/radio/frame/frame.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "bus/radio/frame/cobs.hpp"
#include "bus/radio/frame/coded_block.hpp"
#include "common/random.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

constexpr FrameScope kScope{.table_hash = 0x12345678};
constexpr std::uint64_t kEpoch = 77;

LinkKey Key(std::uint8_t first = 1) {
  LinkKey key{};
  std::iota(key.begin(), key.end(), first);
  return key;
}

/// What lies between the delimiters.
std::span<const std::byte> Encoded(const std::vector<std::byte>& wire) {
  return std::span(wire).first(wire.size() - 1);
}

Opened OpenEncoded(FrameOpener& dut, std::span<const std::byte> encoded, std::uint64_t newest_sent = 0) {
  const auto content = CobsDecode(encoded);
  return content ? dut.Open(*content, newest_sent) : Opened(Reject::kMalformed);
}

struct FrameTest : testing::Test {
  FrameKeys keys{Key()};
  FrameSealer sealer{keys, Direction::kUp, kScope};
  FrameOpener dut{keys, Direction::kUp, kScope};
  void SetUp() override { dut.SetEpoch(kEpoch, 0); }
  std::vector<std::byte> Frame(std::uint64_t counter, const std::string& text = "bundle",
                               CounterForm form = CounterForm::kLowBits) const {
    return sealer.Seal(kEpoch, counter, form, Text(text));
  }
  Reject RejectOf(const std::vector<std::byte>& wire) {
    const Opened opened = OpenEncoded(dut, Encoded(wire));
    EXPECT_TRUE(std::holds_alternative<Reject>(opened));
    return std::get<Reject>(opened);
  }
  std::string TextOf(const std::vector<std::byte>& wire) {
    const Opened opened = OpenEncoded(dut, Encoded(wire));
    const auto* data = std::get_if<DataFrame>(&opened);
    return data == nullptr ? "(refused)" : ToText(data->bundle);
  }
};

TEST_F(FrameTest, RoundTrip) {
  EXPECT_EQ(TextOf(Frame(1)), "bundle");
}

TEST_F(FrameTest, SevenBytesOfOverhead) {
  EXPECT_EQ(Frame(1, std::string(100, 'x')).size(), 100 + kFrameOverhead);
  EXPECT_EQ(Frame(1, std::string(240, 'x')).size(), 240 + kFrameOverhead);
}

TEST_F(FrameTest, NoZeroBeforeTheDelimiter) {
  const auto wire = Frame(1, std::string(50, '\0'));
  EXPECT_EQ(std::count(wire.begin(), wire.end(), kDelimiter), 1);
  EXPECT_EQ(wire.back(), kDelimiter);
}

TEST_F(FrameTest, SixtyFourLostFramesDoNotBreakTheCounter) {
  EXPECT_EQ(TextOf(Frame(1)), "bundle");
  EXPECT_EQ(TextOf(Frame(65)), "bundle");
}

TEST_F(FrameTest, WholeCounterBridgesAnyGap) {
  EXPECT_EQ(TextOf(Frame(1ULL << 39, "bundle", CounterForm::kWhole)), "bundle");
  EXPECT_EQ(TextOf(Frame((1ULL << 39) + 1)), "bundle");
}

TEST_F(FrameTest, ReplayIsRefused) {
  const auto wire = Frame(1);
  EXPECT_EQ(TextOf(wire), "bundle");
  EXPECT_EQ(RejectOf(wire), Reject::kReplayed);
}

TEST_F(FrameTest, ReplayAfterALaterBootIsRefused) {
  const auto low = Frame(10), whole = Frame(11, "bundle", CounterForm::kWhole);
  dut.SetEpoch(kEpoch, 20);  // the floor that survived
  EXPECT_EQ(RejectOf(low), Reject::kReplayed);
  EXPECT_EQ(RejectOf(whole), Reject::kReplayed);
  dut.SetEpoch(kEpoch, 2000);
  EXPECT_EQ(RejectOf(low), Reject::kBadCode);
  EXPECT_EQ(RejectOf(whole), Reject::kReplayed);
}

TEST_F(FrameTest, AnotherEpochIsRefused) {
  const auto wire = Frame(1);
  dut.SetEpoch(kEpoch + 1, 0);
  EXPECT_EQ(RejectOf(wire), Reject::kBadCode);
}

TEST_F(FrameTest, AnotherDirectionIsRefused) {
  const FrameSealer reflected(keys, Direction::kDown, kScope);
  EXPECT_EQ(RejectOf(reflected.Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"))), Reject::kBadCode);
  EXPECT_EQ(RejectOf(reflected.Seal(Hello{.nonce = 1})), Reject::kBadCode);
}

TEST_F(FrameTest, AnotherTableKeyOrModeIsRefused) {
  const FrameSealer table(keys, Direction::kUp, {.table_hash = 1});
  const FrameSealer key(FrameKeys(Key(2)), Direction::kUp, kScope);
  const FrameSealer mode(keys, Direction::kUp, {.table_hash = kScope.table_hash, .encrypted = true});
  for (const FrameSealer* other : {&table, &key, &mode})
    EXPECT_EQ(RejectOf(other->Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"))), Reject::kBadCode);
}

TEST_F(FrameTest, WithoutAnEpochNothingPasses) {
  dut.SetEpoch(0, 0);
  EXPECT_EQ(RejectOf(Frame(1)), Reject::kNoEpoch);
}

TEST_F(FrameTest, EveryFlippedBitIsNoticed) {
  const auto wire = Frame(1, "a bundle of some length");
  for (std::size_t bit = 0; bit < 8 * (wire.size() - 1); ++bit) {
    auto damaged = wire;
    damaged[bit / 8] ^= std::byte{1} << static_cast<int>(bit % 8);
    EXPECT_TRUE(std::holds_alternative<Reject>(OpenEncoded(dut, Encoded(damaged)))) << bit;
  }
  EXPECT_EQ(TextOf(wire), "a bundle of some length");  // none of them has used up the counter
}

TEST_F(FrameTest, CutShortIsMalformed) {
  const auto wire = Frame(1);
  for (std::size_t n = 1; n + 1 < wire.size(); ++n)
    EXPECT_EQ(std::get<Reject>(OpenEncoded(dut, std::span(wire).first(n))), Reject::kMalformed) << n;
}

TEST_F(FrameTest, HelloRoundTrip) {
  for (const std::size_t code_bytes : {4U, 6U, 8U}) {
    const Hello hello{.table_hash = 5,
                      .stream = 6,
                      .nonce = 0x123456789ABCDEF0,
                      .echo = 8,
                      .need = true,
                      .agreed = false,
                      .over = code_bytes == 6,
                      .code_bytes = code_bytes};
    const auto wire = sealer.Seal(hello);
    EXPECT_EQ(wire.size(), kHelloFrameBytes);
    EXPECT_EQ(std::get<Hello>(OpenEncoded(dut, Encoded(wire))), hello);
  }
}

struct CodeTest : testing::TestWithParam<std::size_t> {
  const FrameScope scope{.table_hash = 1, .encrypted = false, .echo_bytes = 0, .code_bytes = GetParam()};
  const FrameKeys keys{Key()};
  const FrameSealer sealer{keys, Direction::kUp, scope};
  FrameOpener dut{keys, Direction::kUp, scope};
  void SetUp() override { dut.SetEpoch(kEpoch, 0); }
};

TEST_P(CodeTest, CostsItsBytes) {
  const auto wire = sealer.Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"));
  EXPECT_EQ(wire.size(), 6 + 3 + GetParam());
  EXPECT_EQ(sealer.overhead(), 3 + GetParam());
  EXPECT_EQ(ToText(std::get<DataFrame>(OpenEncoded(dut, Encoded(wire))).bundle), "bundle");
}

TEST_P(CodeTest, EveryBitOfItIsChecked) {
  const auto wire = sealer.Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"));
  const auto content = CobsDecode(Encoded(wire)).value();
  for (std::size_t bit = 0; bit < 8 * GetParam(); ++bit) {
    auto forged = content;
    forged[forged.size() - 1 - bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_EQ(std::get<Reject>(OpenEncoded(dut, CobsEncode(forged))), Reject::kBadCode) << bit;
  }
}

TEST_P(CodeTest, TheLongestFrameIsOneBlock) {
  const auto wire = sealer.Seal(kEpoch, 1 << 20, CounterForm::kWhole, Text(std::string(240, 'x')));
  EXPECT_EQ(wire.size(), 1 + 1 + 5 + 240 + GetParam() + 1);
  EXPECT_EQ(std::get<DataFrame>(OpenEncoded(dut, Encoded(wire))).counter, 1U << 20);
}

TEST_P(CodeTest, AFrameWithoutRoomForItIsMalformed) {
  EXPECT_EQ(std::get<Reject>(OpenEncoded(dut, CobsEncode(Text(std::string(GetParam(), '\1'))))),
            Reject::kMalformed);
}

INSTANTIATE_TEST_SUITE_P(Bytes, CodeTest, testing::Values(4, 6, 8));

TEST_F(FrameTest, AsABlockItHasTheSameContentFilledUp) {
  const auto wire = sealer.Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"), 0, LineCode::kBlock);
  EXPECT_EQ(wire.size(), sealer.WireBytes(CounterForm::kLowBits, 6, LineCode::kBlock));
  const auto content = DecodeBlock(Encoded(wire));
  ASSERT_TRUE(content);
  EXPECT_EQ(ToText(std::get<DataFrame>(dut.Open(*content)).bundle), std::string("bundle"));
  EXPECT_EQ(
      ToText(std::get<DataFrame>(dut.Open(*DecodeBlock(Encoded(sealer.Seal(
                                     kEpoch, 2, CounterForm::kWhole, Text("bundle"), 0, LineCode::kBlock)))))
                 .bundle),
      std::string("bundle") + std::string(1, '\0'));
}

TEST_F(FrameTest, WhatFitsNoBlockIsNone) {
  const std::size_t most = sealer.MaxBlockBundle(CounterForm::kLowBits);
  const auto is_block = [&](std::size_t bytes) {
    const std::vector<std::byte> bundle(bytes);
    const auto wire = sealer.Seal(kEpoch, 1, CounterForm::kLowBits, bundle, 0, LineCode::kBlock);
    EXPECT_EQ(wire.size(), sealer.WireBytes(CounterForm::kLowBits, bytes, LineCode::kBlock));
    return DecodeBlock(Encoded(wire)).has_value();
  };
  EXPECT_TRUE(is_block(most));
  EXPECT_FALSE(is_block(most + 1));
}

// A memory that is set back makes an end use a counter twice.
TEST_F(FrameTest, TwoTextsWithOneCounterHaveTwoKeyStreams) {
  const FrameSealer sealed(keys, Direction::kUp, {.table_hash = 1, .encrypted = true});
  const auto encrypted = [&](const std::string& text) {
    auto content = CobsDecode(Encoded(sealed.Seal(kEpoch, 9, CounterForm::kWhole, Text(text)))).value();
    content.erase(content.begin(), content.begin() + 1 + kWholeCounterBytes);
    content.resize(text.size());
    return content;
  };
  const std::string first = "attack at dawn", second = "retreat at one";
  const auto a = encrypted(first), b = encrypted(second);
  int same = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    same += (a[i] ^ b[i]) == static_cast<std::byte>(first[i] ^ second[i]) ? 1 : 0;
  EXPECT_LE(same, 2);
  EXPECT_EQ(encrypted(first), a);
}

TEST_F(FrameTest, EncryptedBundleIsNotReadable) {
  const FrameScope scope{.table_hash = 1, .encrypted = true};
  const FrameSealer hidden(keys, Direction::kUp, scope);
  FrameOpener opener(keys, Direction::kUp, scope);
  opener.SetEpoch(kEpoch, 0);
  const auto first = hidden.Seal(kEpoch, 1, CounterForm::kLowBits, Text("attack at dawn"));
  const auto second = hidden.Seal(kEpoch, 2, CounterForm::kLowBits, Text("attack at dawn"));
  EXPECT_EQ(ToText(first).find("attack"), std::string::npos);
  EXPECT_NE(ToText(first).substr(2, 10), ToText(second).substr(2, 10));
  EXPECT_EQ(ToText(std::get<DataFrame>(OpenEncoded(opener, Encoded(first))).bundle), "attack at dawn");
}

/// A direction with commands: what its short frames echo is authenticated, but for the most part not sent.
struct EchoTest : testing::TestWithParam<std::size_t> {
  static FrameScope Scope() { return {.table_hash = 1, .encrypted = false, .echo_bytes = GetParam()}; }
  static std::uint64_t Range() { return std::uint64_t{1} << (8 * GetParam()); }
  Opened Open(std::uint64_t echo, std::uint64_t newest_sent, CounterForm form = CounterForm::kLowBits) {
    dut.SetEpoch(kEpoch, 0);
    return OpenEncoded(dut, Encoded(sealer.Seal(kEpoch, 1, form, Text("bundle"), echo)), newest_sent);
  }
  const FrameKeys keys{Key()};
  const FrameSealer sealer{keys, Direction::kUp, Scope()};
  FrameOpener dut{keys, Direction::kUp, Scope()};
};

TEST_P(EchoTest, IsCompletedBelowTheNewestFrameSent) {
  const std::uint64_t newest = 123'456'789;
  for (const std::uint64_t back : {std::uint64_t{0}, std::uint64_t{1}, Range() / 2, Range() - 1})
    EXPECT_EQ(std::get<DataFrame>(Open(newest - back, newest)).echo, newest - back) << back;
}

TEST_P(EchoTest, OfAFrameTooLongAgoOrNeverSentIsAWrongCode) {
  const std::uint64_t newest = 123'456'789;
  for (const std::uint64_t echo : {newest - Range(), newest - 5 * Range(), newest + 1, newest + Range()})
    EXPECT_EQ(std::get<Reject>(Open(echo, newest)), Reject::kBadCode) << echo;
  EXPECT_EQ(std::get<Reject>(Open(5, 4)), Reject::kBadCode) << "nor below the first counter";
}

TEST_P(EchoTest, CostsItsBytesAndOnlyInShortFrames) {
  EXPECT_EQ(sealer.Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"), 7).size(),
            6 + kFrameOverhead + GetParam());
  EXPECT_EQ(sealer.overhead(), kFrameOverhead + GetParam());
  const FrameSealer plain(keys, Direction::kUp, {.table_hash = 1});
  EXPECT_EQ(sealer.Seal(kEpoch, 1, CounterForm::kWhole, Text("bundle"), 7),
            plain.Seal(kEpoch, 1, CounterForm::kWhole, Text("bundle")));
  EXPECT_FALSE(std::get<DataFrame>(Open(7, 9, CounterForm::kWhole)).echo);
}

TEST_P(EchoTest, AnOpenerThatExpectsNoneRefusesIt) {
  FrameOpener plain(keys, Direction::kUp, {.table_hash = 1});
  plain.SetEpoch(kEpoch, 0);
  const auto wire = sealer.Seal(kEpoch, 1, CounterForm::kLowBits, Text("bundle"), 7);
  EXPECT_EQ(std::get<Reject>(OpenEncoded(plain, Encoded(wire), 9)), Reject::kBadCode);
}

INSTANTIATE_TEST_SUITE_P(Bytes, EchoTest, testing::Values(std::size_t{1}, std::size_t{2}));

TEST_F(FrameTest, RandomBytesNeverPass) {
  Rng rng(4);
  for (int i = 0; i < 100000; ++i) {
    std::vector<std::byte> noise(1 + rng.Below(60));
    for (std::byte& b : noise) b = static_cast<std::byte>(1 + rng.Below(255));
    noise.push_back(kDelimiter);
    RejectOf(noise);
    RejectOf([&] {  // well-formed, so that the code is what refuses it
      auto content = CobsEncode(noise);
      content.push_back(kDelimiter);
      return content;
    }());
  }
}

TEST(FrameSealer, RefusesWhatItCannotProtect) {
  const FrameSealer dut(FrameKeys(Key()), Direction::kUp, kScope);
  const std::vector<std::byte> bundle(241);
  EXPECT_THROW(dut.Seal(1, 1, CounterForm::kWhole, bundle), std::invalid_argument);
  EXPECT_THROW(dut.Seal(0, 1, CounterForm::kWhole, {}), std::invalid_argument);
  EXPECT_THROW(dut.Seal(1, std::uint64_t{1} << 40, CounterForm::kWhole, {}), std::invalid_argument);
}

}  // namespace
}  // namespace priamos::bus::radio
