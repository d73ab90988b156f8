#include "bus/radio/link_state.hpp"

#include <gtest/gtest.h>

namespace priamos::bus::radio {
namespace {

LinkState Example() {
  LinkState state;
  state.table_hash = 1;
  state.epoch = 0x1122334455667788;
  state.send_next = 300;
  state.receive_floor = 1ULL << 39;
  state.floor_exact = false;
  state.stream = 7;
  state.peer_stream = 8;
  state.send_event = {1, 2};
  state.receive_event = {3, 4};
  state.receive_known = {0, 1};
  state.events = {
      {.channel = 1, .first = 250, .packed_utime = -5, .bits = 11, .packed = {std::byte{1}, std::byte{2}}}};
  return state;
}

TEST(LinkState, RoundTrip) {
  EXPECT_EQ(ParseLinkState(Serialise(Example())), Example());
}

TEST(LinkState, TheKeyTakesRoomOnlyWhenItIsNoted) {
  LinkState state = Example();
  const std::size_t without = Serialise(state).size();
  state.key_check = 0x01020304;
  EXPECT_EQ(Serialise(state).size(), without + 4);
  EXPECT_EQ(ParseLinkState(Serialise(state)), state);
}

TEST(LinkState, DamageAnywhereIsNoticed) {
  LinkState state = Example();
  state.key_check = 7;
  const auto bytes = Serialise(state);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto damaged = bytes;
    damaged[i] ^= std::byte{0x10};
    EXPECT_FALSE(ParseLinkState(damaged)) << i;
    EXPECT_FALSE(ParseLinkState(std::span(bytes).first(i))) << i;
  }
}

}  // namespace
}  // namespace priamos::bus::radio
