#include "bus/radio/next_key.hpp"

#include <gtest/gtest.h>

#include "bus/radio/peer.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

constexpr LinkKey kKey{4, 5, 6};
constexpr Time kStart{Duration(1'000'000'000)};
Time After(double seconds) {
  return kStart + FromSeconds(seconds);
}

struct NextKeyTest : testing::Test {
  NextKey dut{KeyCheck(kKey), FrameKeys(kKey), FrameSealer(FrameKeys(kKey), Direction::kUp, {}),
              Handshake(
                  7, [] { return std::uint64_t{11}; }, false, kStart)};
};

TEST_F(NextKeyTest, IsAnnouncedEveryTwoSecondsAtMost) {
  EXPECT_TRUE(dut.Due(After(0)));
  EXPECT_EQ(dut.Take(After(0)).check, KeyCheck(kKey));
  EXPECT_FALSE(dut.Due(After(1.9)));
  EXPECT_TRUE(dut.Due(After(2)));
  dut.Take(After(2));
  dut.Return();
  EXPECT_TRUE(dut.Due(After(2.01))) << "the frame was cut off";
}

TEST_F(NextKeyTest, GoesAgainWhenItsFrameWasCutOff) {
  const ChannelTable table{TestChannels(), false};
  Peer peer{.handshake = dut.handshake, .next_key = dut};
  const auto load = [&](bool ack_only) {
    BundleBuilder bundle(table, 100, false);
    return peer.Load(bundle, {}, ack_only, After(1));
  };
  EXPECT_FALSE(load(true).next_key) << "not in a frame for acknowledgements";
  const Peer::Loaded loaded = load(false);
  EXPECT_TRUE(loaded.next_key);
  EXPECT_FALSE(load(false).next_key);
  peer.Return(loaded);
  EXPECT_TRUE(load(false).next_key);
}

TEST_F(NextKeyTest, OnlyTheSameKeyIsAskedForAndForASecond) {
  dut.OnAnnounced({KeyCheck(kKey) + 1}, After(0));
  EXPECT_EQ(dut.ReceptionOf(Reception::kHeard, After(0)), Reception::kHeard);
  dut.OnAnnounced({KeyCheck(kKey)}, After(1));
  EXPECT_EQ(dut.ReceptionOf(Reception::kHeard, After(1.9)), Reception::kUnusable);
  EXPECT_EQ(dut.ReceptionOf(Reception::kHeard, After(2)), Reception::kHeard);
}

TEST_F(NextKeyTest, WithoutDataBothKeysAreTried) {
  EXPECT_EQ(dut.ReceptionOf(Reception::kSilent, After(0)), Reception::kSilent);
  EXPECT_EQ(dut.ReceptionOf(Reception::kUnusable, After(0)), Reception::kUnusable);
}

TEST_F(NextKeyTest, AnAnnouncingHelloIsASignAndProvesNothing) {
  EXPECT_FALSE(dut.OnHello({.table_hash = 7, .nonce = 5}, After(0)).agreed);
  EXPECT_EQ(dut.ReceptionOf(Reception::kHeard, After(0.5)), Reception::kUnusable);
}

TEST_F(NextKeyTest, AHelloThatEchoesAgrees) {
  const auto proof = dut.OnHello({.table_hash = 7, .nonce = 5, .echo = 11, .need = true}, After(0));
  ASSERT_TRUE(proof.agreed);
  EXPECT_EQ(proof.agreed->own, 11U);
  EXPECT_EQ(proof.agreed->peer, 5U);
}

}  // namespace
}  // namespace priamos::bus::radio
