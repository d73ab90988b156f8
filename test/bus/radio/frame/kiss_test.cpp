#include "bus/radio/frame/kiss.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "test/support/radio/bytes.hpp"

namespace priamos::bus::radio {
namespace {

using support::Bytes;

std::vector<std::vector<std::byte>> Decode(KissDecoder& dut, const std::vector<std::byte>& bytes) {
  std::vector<std::vector<std::byte>> packets;
  for (const std::byte byte : bytes)
    if (auto packet = dut.Push(byte)) packets.push_back(std::move(*packet));
  return packets;
}

TEST(Kiss, ExamplesOfThePublication) {
  EXPECT_EQ(EncodeKiss(Bytes({'T', 'E', 'S', 'T'})), Bytes({0xC0, 0, 'T', 'E', 'S', 'T', 0xC0}));
  EXPECT_EQ(EncodeKiss(Bytes({0xC0, 0xDB})), Bytes({0xC0, 0, 0xDB, 0xDC, 0xDB, 0xDD, 0xC0}));
}

RC_GTEST_PROP(Kiss, PacketsComeBackBetweenAnyNoise, (const std::vector<std::uint8_t>& values)) {
  std::vector<std::byte> packet;
  for (const std::uint8_t v : values) packet.push_back(static_cast<std::byte>(v));
  packet.resize(std::min<std::size_t>(packet.size() + 1, 200));
  KissDecoder dut(200);
  Decode(dut, Bytes({1, 2, 0xDB}));  // the end of a packet that began before
  const auto bytes = EncodeKiss(packet);
  const std::vector<std::vector<std::byte>> expected{packet};
  RC_ASSERT(Decode(dut, bytes) == expected);
  RC_ASSERT(dut.between_packets());
  RC_ASSERT(Decode(dut, bytes) == expected);
}

TEST(KissDecoder, PassesOverWhatIsNoDataForIt) {
  KissDecoder dut(4);
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0xC0, 0xC0})), testing::IsEmpty()) << "nothing";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0, 0xC0})), testing::IsEmpty()) << "an empty packet";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 6, 1, 0xC0})), testing::IsEmpty()) << "a setting of the radio";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0x10, 1, 0xC0})), testing::IsEmpty()) << "another radio";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0, 1, 2, 3, 4, 5, 0xC0})), testing::IsEmpty()) << "too long";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0, 0xDB, 1, 0xC0})), testing::IsEmpty()) << "not escaped by anybody";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0, 1, 0xDB, 0xC0})), testing::IsEmpty()) << "cut in an escape";
  EXPECT_THAT(Decode(dut, Bytes({0xC0, 0, 1, 2, 3, 4, 0xC0})), testing::ElementsAre(Bytes({1, 2, 3, 4})));
}

}  // namespace
}  // namespace priamos::bus::radio
