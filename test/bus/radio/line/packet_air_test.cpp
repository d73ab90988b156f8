#include "bus/radio/line/packet_air.hpp"

#include <gmock/gmock.h>

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Time kStart = FromUtime(1'000'000);

std::vector<std::byte> Packet(std::size_t bytes) {
  return std::vector<std::byte>(bytes, std::byte{7});
}

PacketAirConfig Slow() {
  return {.bytes_per_s = 100, .overhead_s = 0.5, .mtu_bytes = 200, .latency_s = 0.01};
}

Time At(double seconds) {
  return kStart + FromSeconds(seconds);
}

PacketAir AirOf(const PacketAirConfig& config) {
  return {config, Rng::Stream(1, "air"), kStart};
}

TEST(PacketAir, APacketArrivesWholeWhenItHasEnded) {
  PacketAir dut = AirOf(Slow());
  dut.Send(0, Packet(100), At(1));
  EXPECT_EQ(dut.free_at(0), At(2.5));
  EXPECT_EQ(dut.next_arrival(), At(2.51));
  EXPECT_THAT(dut.Receive(1, At(2.509)), IsEmpty());
  EXPECT_THAT(dut.Receive(1, At(2.51)), ElementsAre(Packet(100)));
  EXPECT_THAT(dut.Receive(1, At(9)), IsEmpty());
  EXPECT_THAT(dut.Receive(0, At(9)), IsEmpty()) << "nobody hears itself";
  EXPECT_EQ(dut.next_arrival(), Time::max());
}

TEST(PacketAir, ARadioSendsOneAfterTheOther) {
  PacketAir dut = AirOf(Slow());
  dut.Send(0, Packet(50), At(1));
  dut.Send(0, Packet(10), At(1));
  EXPECT_THAT(dut.Receive(1, At(2.59)), ElementsAre(Packet(50)));
  EXPECT_THAT(dut.Receive(1, At(2.62)), ElementsAre(Packet(10)));
}

TEST(PacketAir, PacketsThatMeetOnOneChannelAreLost) {
  for (const bool half_duplex : {false, true}) {
    PacketAirConfig config = Slow();
    config.half_duplex = half_duplex;
    PacketAir dut = AirOf(config);
    dut.Send(0, Packet(50), At(1));  // until 2
    dut.Send(1, Packet(50), At(1.9));
    dut.Send(1, Packet(20), At(3));
    EXPECT_EQ(dut.Receive(1, At(9)).size(), half_duplex ? 0U : 1U);
    EXPECT_EQ(dut.Receive(0, At(9)).size(), half_duplex ? 1U : 2U);
    EXPECT_EQ(dut.collisions(), half_duplex ? 1U : 0U);
  }
}

TEST(PacketAir, LosesWhatItShould) {
  PacketAirConfig config = Slow();
  config.loss = 0.3;
  config.bytes_per_s = 1e6;
  config.overhead_s = 0;
  config.cuts = {{1000, 1100}};
  PacketAir dut = AirOf(config);
  std::size_t before = 0, inside = 0;
  for (int i = 0; i < 10000; ++i) {
    const double s = 0.1 * i;
    dut.Send(0, Packet(10), At(s));
    before += dut.Receive(1, At(s + 0.05)).size();
  }
  for (int i = 0; i < 1000; ++i) {
    dut.Send(0, Packet(10), At(1000 + 0.1 * i));
    inside += dut.Receive(1, At(1000 + 0.1 * i + 0.05)).size();
  }
  EXPECT_NEAR(static_cast<double>(before), 7000, 200);
  EXPECT_EQ(inside, 0U);
}

TEST(PacketAir, ATooLongPacketIsNotSent) {
  PacketAir dut = AirOf(Slow());
  dut.Send(0, Packet(201), At(1));
  dut.Send(0, {}, At(1));
  EXPECT_EQ(dut.free_at(0), kStart);
  EXPECT_EQ(dut.next_arrival(), Time::max());
}

}  // namespace
}  // namespace priamos::bus::radio
