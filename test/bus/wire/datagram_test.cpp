#include "bus/wire/datagram.hpp"

#include <gtest/gtest.h>

#include <string>

#include "common/random.hpp"

namespace priamos::bus {
namespace {

struct Parsed {
  bool good = false;
  std::uint32_t number = 0;
  std::string channel;
  std::string bytes;
};

Parsed Parse(const std::string& datagram) {
  Parsed parsed;
  std::string_view channel;
  std::span<const std::byte> bytes;
  parsed.good = ParseDatagram(std::as_bytes(std::span(datagram)), parsed.number, channel, bytes);
  if (!parsed.good) return parsed;
  parsed.channel = channel;
  parsed.bytes.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return parsed;
}

std::string Datagram(const std::string& behind) {
  return std::string("LC02\0\0\1\2", 8) + behind;
}

TEST(ParseDatagram, TakesWhatLcmSends) {
  const auto dut = Parse(Datagram(std::string("POSE\0data", 9)));
  ASSERT_TRUE(dut.good);
  EXPECT_EQ(dut.number, 0x102u);
  EXPECT_EQ(dut.channel, "POSE");
  EXPECT_EQ(dut.bytes, "data");
}

TEST(ParseDatagram, TakesAnEmptyMessageAndTheLongestName) {
  EXPECT_TRUE(Parse(Datagram(std::string("POSE\0", 5))).good);
  EXPECT_TRUE(Parse(Datagram(std::string(63, 'C') + '\0')).good);
}

TEST(ParseDatagram, RefusesWhatIsNone) {
  EXPECT_FALSE(Parse("").good);
  EXPECT_FALSE(Parse("LC02").good);
  EXPECT_FALSE(Parse(Datagram("")).good);
  EXPECT_FALSE(Parse(Datagram("POSE without an end")).good);
  EXPECT_FALSE(Parse(Datagram(std::string(64, 'C') + '\0')).good);
  EXPECT_FALSE(Parse(Datagram(std::string("\0data", 5))).good);
  EXPECT_FALSE(Parse(Datagram(std::string("PO\nSE\0data", 10))).good);
  EXPECT_FALSE(Parse("LC03\0\0\0\1POSE\0data").good);
}

TEST(ParseDatagram, RandomBytesAreRefusedOrWithinTheDatagram) {
  Rng rng(1);
  for (int i = 0; i < 20'000; ++i) {
    std::string datagram = Datagram("");
    for (auto n = rng.Below(100); n > 0; --n) datagram.push_back(static_cast<char>(rng.Below(4)));
    const auto dut = Parse(datagram);
    EXPECT_TRUE(!dut.good || dut.channel.size() + dut.bytes.size() + 9 == datagram.size());
  }
}

}  // namespace
}  // namespace priamos::bus
