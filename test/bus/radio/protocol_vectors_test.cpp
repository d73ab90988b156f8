#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sodium.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/cobs.hpp"
#include "bus/radio/frame/forgery.hpp"
#include "bus/radio/frame/frame.hpp"

// The specification is a promise to whoever writes another implementation: bus/radio/PROTOCOL.md is read
// here, and the code must say the same.

namespace priamos::bus::radio {
namespace {

std::string ProtocolBlock(const std::string& name) {
  std::ifstream in(std::string(PRIAMOS_SOURCE_DIR) + "/bus/radio/PROTOCOL.md");
  std::string line, block;
  while (std::getline(in, line) && line != "```" + name) {
  }
  while (std::getline(in, line) && line != "```") block += line + "\n";
  return block;
}

std::vector<std::byte> FromHex(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::string ToHex(std::span<const std::byte> bytes) {
  std::string hex;
  for (const std::byte b : bytes) {
    hex += "0123456789abcdef"[std::to_integer<unsigned>(b >> 4)];
    hex += "0123456789abcdef"[std::to_integer<unsigned>(b & std::byte{15})];
  }
  return hex;
}

struct ProtocolVectors : testing::Test {
  ProtocolVectors() {
    std::istringstream in(ProtocolBlock("vectors"));
    std::string name, equals, value;
    while (in >> name >> equals >> value) values[name] = value;
    const auto bytes = FromHex(values.at("link_key"));
    for (std::size_t i = 0; i < key.size(); ++i) key[i] = std::to_integer<std::uint8_t>(bytes.at(i));
  }
  std::uint64_t Number(const std::string& name) const { return std::stoull(values.at(name), nullptr, 16); }
  ChannelTable Table(bool encrypted = false, std::size_t code_bytes = kShortCodeBytes) const {
    std::istringstream in(ProtocolBlock("table"));
    std::vector<LinkChannel> channels;
    LinkChannel c;
    int direction = 0, channel_class = 0;
    std::int64_t ttl_us = 0;
    while (in >> c.name >> std::hex >> c.fingerprint >> std::dec >> direction >> channel_class >>
           c.fixed_bits >> c.max_bits >> ttl_us) {
      c.direction = static_cast<Direction>(direction);
      c.channel_class = static_cast<ChannelClass>(channel_class);
      c.ttl = Duration(ttl_us);
      channels.push_back(c);
    }
    return {channels, encrypted, code_bytes};
  }
  std::vector<std::byte> BundleUp() const {
    const ChannelTable table = Table();
    BundleWriter out(table);
    out.Write(FrameAckEntry{0x7ab, 0b0101, std::chrono::milliseconds(37), 3.0 / 15});
    out.Write(FloorEntry{1000});
    out.Write(StateEntry{0, 83, FromHex("0123456789abcdef0123e0")});
    EventSegment door;
    door.number = 254;
    door.base = door.first = door.last = true;
    door.age = std::chrono::milliseconds(1500);
    door.bytes = FromHex("646f6f72");
    door.bits = 32;
    out.Write(EventEntry{2, door});
    out.Write(OverEntry{});
    return out.bytes();
  }
  std::vector<std::byte> BundleDown() const {
    const ChannelTable table = Table();
    BundleWriter out(table);
    out.Write(EventAckEntry{2, {.next = 255, .prefix = 2, .held = 0b1001}});
    out.Write(ListenEntry{0b100});
    out.Write(CommandEntry{1, std::chrono::milliseconds(-100), 40, FromHex("deadbeef42")});
    return out.bytes();
  }
  Hello HelloDown() const {
    Hello hello;
    hello.table_hash = Table().hash();
    hello.stream = 0xcafe0001;
    hello.nonce = Number("offboard_nonce");
    hello.echo = Number("onboard_nonce");
    hello.agreed = hello.over = true;
    return hello;
  }
  /// Only the direction down has a command, and an echo.
  FrameScope Scope(Direction direction, bool encrypted, std::size_t echo_bytes = 1) const {
    return {Table(encrypted).hash(), encrypted, direction == Direction::kDown ? echo_bytes : 0};
  }
  FrameSealer Sealer(Direction direction, bool encrypted = false, std::size_t echo_bytes = 1) const {
    return {FrameKeys(key), direction, Scope(direction, encrypted, echo_bytes)};
  }

  std::map<std::string, std::string> values;
  LinkKey key{};
};

TEST_F(ProtocolVectors, DerivedKeys) {
  for (const std::string purpose : {"authentication", "encryption"}) {
    const std::string text = "priamos radio 1 " + purpose;
    std::array<std::byte, 32> derived{};
    crypto_generichash(reinterpret_cast<unsigned char*>(derived.data()), derived.size(),
                       reinterpret_cast<const unsigned char*>(text.data()), text.size(), key.data(),
                       key.size());
    EXPECT_EQ(ToHex(derived), values.at(purpose + "_key"));
  }
}

TEST_F(ProtocolVectors, TableHash) {
  EXPECT_EQ(Table().hash(), Number("table_hash"));
  EXPECT_EQ(Table(true).hash(), Number("table_hash_sealed"));
}

TEST_F(ProtocolVectors, Epoch) {
  EXPECT_EQ(FrameKeys(key).EpochOf(Number("onboard_nonce"), Number("offboard_nonce")), Number("epoch"));
}

TEST_F(ProtocolVectors, CobsAndDurations) {
  EXPECT_EQ(ToHex(CobsEncode(FromHex("11000022"))), values.at("cobs_of_11_00_00_22"));
  EXPECT_EQ(EncodeDuration12(std::chrono::milliseconds(37)), Number("duration_37_ms"));
  EXPECT_EQ(EncodeDuration12(std::chrono::milliseconds(1500)), Number("duration_1500_ms"));
  EXPECT_EQ(EncodeDuration12(std::chrono::hours(1)), Number("duration_3600000_ms"));
}

TEST_F(ProtocolVectors, Bundles) {
  EXPECT_EQ(ToHex(BundleUp()), values.at("bundle_up"));
  EXPECT_EQ(ToHex(BundleDown()), values.at("bundle_down"));
  const ParsedBundle up = ParseBundle(Table(), Direction::kUp, FromHex(values.at("bundle_up")));
  EXPECT_TRUE(up.whole);
  EXPECT_EQ(up.entries.size(), 5U);
}

TEST_F(ProtocolVectors, Run) {
  const auto segment = [](std::uint8_t number, bool base, int age_ms, const std::string& hex) {
    EventEntry entry{2, {}};
    entry.segment.number = number;
    entry.segment.base = base;
    entry.segment.first = entry.segment.last = true;
    entry.segment.age = std::chrono::milliseconds(age_ms);
    entry.segment.bytes = FromHex(hex);
    entry.segment.bits = 8 * entry.segment.bytes.size();
    return entry;
  };
  const ChannelTable table = Table();
  BundleWriter run(table);
  run.Write(segment(7, true, 0, "61"));
  run.Write(segment(8, false, 37, "6263"));
  EXPECT_EQ(ToHex(run.bytes()), values.at("bundle_run"));
  const ParsedBundle parsed = ParseBundle(table, Direction::kUp, run.bytes());
  ASSERT_EQ(parsed.entries.size(), 2U);
  EXPECT_EQ(std::get<EventEntry>(parsed.entries[1]).segment.number, 8);
}

TEST_F(ProtocolVectors, Differences) {
  LinkChannel pose = Table().at(0);
  pose.fixed_bits = pose.max_bits = 40;
  pose.delta = {15, 13, 3, 9};
  const ChannelTable table({pose}, false);
  EXPECT_EQ(table.hash(), Number("difference_table_hash"));
  const auto baseline = FromHex(values.at("difference_baseline"));
  const auto message = FromHex(values.at("difference_message"));
  const BitWriter delta = EncodeDelta(pose.delta, baseline, message);
  EXPECT_EQ(delta.bits(), 33U);
  EXPECT_EQ(ToHex(delta.bytes()), values.at("difference"));
  EXPECT_EQ(ApplyDelta(pose.delta, baseline, delta.bytes()), message);
  BundleWriter bundle(table);
  bundle.Write(StateEntry{0, 33, delta.bytes(), 300 & 63});
  bundle.Write(ForgetEntry{});
  EXPECT_EQ(ToHex(bundle.bytes()), values.at("difference_bundle"));
  const ParsedBundle parsed = ParseBundle(table, Direction::kUp, bundle.bytes());
  ASSERT_EQ(parsed.entries.size(), 2U);
  EXPECT_EQ(std::get<StateEntry>(parsed.entries[0]).packed, delta.bytes());
}

TEST_F(ProtocolVectors, NextKey) {
  EXPECT_EQ(KeyCheck(key), Number("key_check"));
  const ChannelTable table = Table();
  BundleWriter bundle(table);
  bundle.Write(NextKeyEntry{KeyCheck(key)});
  bundle.Write(ForgetEntry{});
  EXPECT_EQ(ToHex(bundle.bytes()), values.at("bundle_next_key"));
  const ParsedBundle parsed = ParseBundle(table, Direction::kUp, FromHex(values.at("bundle_next_key")));
  EXPECT_TRUE(parsed.whole);
  ASSERT_EQ(parsed.entries.size(), 2U);
  EXPECT_EQ(std::get<NextKeyEntry>(parsed.entries[0]).check, Number("key_check"));
}

TEST_F(ProtocolVectors, DataFrames) {
  const auto wire = [&](Direction direction, std::uint64_t counter, CounterForm form, bool encrypted,
                        std::size_t echo_bytes = 1) {
    const auto bundle = direction == Direction::kUp ? BundleUp() : BundleDown();
    return ToHex(Sealer(direction, encrypted, echo_bytes).Seal(Number("epoch"), counter, form, bundle, 300));
  };
  EXPECT_EQ(wire(Direction::kUp, 300, CounterForm::kLowBits, false), values.at("frame_up_counter_300"));
  EXPECT_EQ(wire(Direction::kUp, 300, CounterForm::kWhole, false), values.at("frame_up_counter_300_whole"));
  EXPECT_EQ(wire(Direction::kDown, 7, CounterForm::kLowBits, false), values.at("frame_down_counter_7"));
  EXPECT_EQ(wire(Direction::kDown, 7, CounterForm::kLowBits, true),
            values.at("frame_down_counter_7_encrypted"));
  EXPECT_EQ(wire(Direction::kDown, 7, CounterForm::kLowBits, false, 2),
            values.at("frame_down_counter_7_fast"));
  EXPECT_EQ(wire(Direction::kDown, 7, CounterForm::kWhole, false), values.at("frame_down_counter_7_whole"));
}

TEST_F(ProtocolVectors, Block) {
  EXPECT_EQ(ToHex(Sealer(Direction::kDown)
                      .Seal(Number("epoch"), 7, CounterForm::kLowBits, BundleDown(), 300, LineCode::kBlock)),
            values.at("block_down_counter_7"));
}

TEST_F(ProtocolVectors, LongerCodes) {
  for (const std::size_t code_bytes : {6U, 8U}) {
    const auto name = [&](const char* what) { return fmt::format("{}_code_{}", what, code_bytes); };
    const std::uint32_t hash = Table(false, code_bytes).hash();
    EXPECT_EQ(hash, Number(name("table_hash")));
    const FrameSealer sealer(
        FrameKeys(key), Direction::kDown,
        {.table_hash = hash, .encrypted = false, .echo_bytes = 1, .code_bytes = code_bytes});
    EXPECT_EQ(ToHex(sealer.Seal(Number("epoch"), 7, CounterForm::kLowBits, BundleDown(), 300)),
              values.at(name("frame_down_counter_7")));
    Hello hello = HelloDown();
    hello.table_hash = hash;
    hello.code_bytes = code_bytes;
    EXPECT_EQ(ToHex(sealer.Seal(hello)), values.at(name("hello_down")));
  }
}

TEST_F(ProtocolVectors, FramesOfASharedChannel) {
  const auto sealer = [&](Direction direction) {
    FrameScope scope = Scope(direction, false);
    scope.address = 3;
    return FrameSealer(FrameKeys(key), direction, scope);
  };
  const FrameSealer down = sealer(Direction::kDown);
  EXPECT_EQ(ToHex(sealer(Direction::kUp).Seal(Number("epoch"), 300, CounterForm::kLowBits, BundleUp())),
            values.at("frame_up_counter_300_address_3"));
  EXPECT_EQ(ToHex(down.Seal(Number("epoch"), 7, CounterForm::kLowBits, BundleDown(), 300)),
            values.at("frame_down_counter_7_address_3"));
  EXPECT_EQ(ToHex(down.Seal(Number("epoch"), 7, CounterForm::kWhole, BundleDown(), 300)),
            values.at("frame_down_counter_7_whole_address_3"));
  EXPECT_EQ(ToHex(down.Seal(HelloDown())), values.at("hello_down_address_3"));
}

TEST_F(ProtocolVectors, TheFigureOfTheDefaultLength) {
  EXPECT_NEAR(ForgerySeconds(960, 4) / 86400, 251, 1);
  EXPECT_NEAR(ForgerySeconds(100'000, 6) / (365.25 * 86400), 556, 1);
  EXPECT_EQ(DefaultCodeBytes(1339), 4U);
  EXPECT_EQ(DefaultCodeBytes(1341), 6U);
}

TEST_F(ProtocolVectors, FramesOpen) {
  FrameOpener dut(FrameKeys(key), Direction::kDown, Scope(Direction::kDown, true));
  dut.SetEpoch(Number("epoch"), 0);
  auto wire = FromHex(values.at("frame_down_counter_7_encrypted"));
  wire.pop_back();
  const Opened opened = dut.Open(CobsDecode(wire).value(), 310);
  ASSERT_TRUE(std::holds_alternative<DataFrame>(opened));
  EXPECT_EQ(std::get<DataFrame>(opened).echo, 300U);
  EXPECT_EQ(ToHex(std::get<DataFrame>(opened).bundle), values.at("bundle_down"));
}

TEST_F(ProtocolVectors, HelloFrame) {
  EXPECT_EQ(ToHex(Sealer(Direction::kDown).Seal(HelloDown())), values.at("hello_down"));
}

}  // namespace
}  // namespace priamos::bus::radio
