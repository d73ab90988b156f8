#include "bus/log_follower.hpp"

#include <gtest/gtest.h>

// With a bus, a player and the planner: test/system/followed_log_test.cpp.

namespace priamos::bus {
namespace {

TEST(LogFollower, WhatItSendsIsOnChannelsOfItsOwn) {
  const Schema schema{std::vector<Schema::Source>{}};
  LcmBus bus("memq://");
  std::string heard;
  LogFollower follower(bus, schema, "planner", {});
  bus.SubscribeEverything([&](std::string_view channel, std::span<const std::byte>) { heard = channel; });
  bus.Publish("PATH", {});
  bus.Drain();
  EXPECT_EQ(heard, "REPLAYED_PATH");
}

}  // namespace
}  // namespace priamos::bus
