#include "radio/kiss_port.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <deque>

#include "bus/radio/frame/kiss.hpp"
#include "test/support/radio/bytes.hpp"

namespace priamos::radio {
namespace {

using support::Bytes;

using testing::IsEmpty;

/// What the test and the port have written to each other.
struct Wire {
  std::deque<std::byte> to_port;
  std::vector<std::byte> from_port;
  std::size_t takes = 1000;  ///< so many bytes go into the serial port at once
};

class FakeSerial : public ByteStream {
 public:
  explicit FakeSerial(Wire& wire) : wire_(wire) {}
  std::size_t Read(std::span<std::byte> into) override {
    const std::size_t n = std::min(into.size(), wire_.to_port.size());
    std::copy_n(wire_.to_port.begin(), n, into.begin());
    wire_.to_port.erase(wire_.to_port.begin(), wire_.to_port.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }
  std::size_t Write(std::span<const std::byte> bytes) override {
    const std::size_t n = std::min(bytes.size(), wire_.takes);
    wire_.from_port.insert(wire_.from_port.end(), bytes.begin(),
                           bytes.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }

 private:
  Wire& wire_;
};

struct KissPort : testing::Test {
  Wire wire;
  std::unique_ptr<NetPort> dut = OpenKissPort(std::make_unique<FakeSerial>(wire));
  Time now = FromUtime(5'000'000);
  std::vector<NetFrame> Read() {
    return dut->Read([this] { return now; });
  }
  void Feed(const std::vector<std::byte>& bytes) {
    wire.to_port.insert(wire.to_port.end(), bytes.begin(), bytes.end());
  }
};

TEST_F(KissPort, AFrameIsAPacketWithoutItsDelimiter) {
  EXPECT_EQ(dut->Write(Bytes({1, 0xC0, 2}), now), 3U);
  EXPECT_THAT(wire.from_port, IsEmpty()) << "not whole yet";
  dut->Write(Bytes({3, 0}), now);
  EXPECT_EQ(wire.from_port, bus::radio::EncodeKiss(Bytes({1, 0xC0, 2, 3})));
  wire.from_port.clear();
  dut->Write(Bytes({0}), now);
  EXPECT_THAT(wire.from_port, IsEmpty()) << "a lone delimiter is nothing";
}

TEST_F(KissPort, WhatTheSerialPortDoesNotTakeFollowsAndAPacketBehindItIsLost) {
  wire.takes = 3;
  dut->Write(Bytes({1, 2, 3, 0}), now);
  dut->Write(Bytes({9, 0}), now);
  for (int i = 0; i < 5; ++i) Read();
  EXPECT_EQ(wire.from_port, bus::radio::EncodeKiss(Bytes({1, 2, 3})));
}

TEST_F(KissPort, PacketsComeWithTheTimesOfTheirFirstAndLastByte) {
  auto packet = bus::radio::EncodeKiss(Bytes({4, 5}));
  packet.erase(packet.begin(), packet.begin() + 2);  // its second half comes later
  Feed(Bytes({0xC0, 0}));
  EXPECT_THAT(Read(), IsEmpty());
  now += Duration(700);
  Feed(packet);
  const auto frames = Read();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].bytes, Bytes({4, 5}));
  EXPECT_EQ(frames[0].first_byte, now - Duration(700));
  EXPECT_EQ(frames[0].arrived, now);
  EXPECT_FALSE(frames[0].stranger);
}

TEST(KissPortName, IsKissAndATty) {
  EXPECT_TRUE(IsKissPort("kiss:/dev/ttyUSB0"));
  EXPECT_FALSE(IsKissPort("/dev/ttyUSB0"));
  EXPECT_EQ(TtyOf("kiss:/dev/ttyUSB0"), "/dev/ttyUSB0");
}

}  // namespace
}  // namespace priamos::radio
