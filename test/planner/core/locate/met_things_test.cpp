#include "planner/core/locate/met_things.hpp"

#include <gmock/gmock.h>

namespace priamos::planner {
namespace {

TEST(MetThings, AnEchoThatIsHeardAgainIsOneAndOneFarAwayIsNone) {
  MetThings dut;
  dut.OnEcho({1, 0}, 0.3);
  dut.OnEcho({1.05, 0.05}, 0.25);
  dut.OnEcho({3, 0}, 2.3);
  ASSERT_EQ(dut.Echoes({{0, 0, 0}}).size(), 1U);
  EXPECT_NEAR(dut.Echoes({{0, 0, 0}})[0].map_from_centre.x, 1, 1e-9);
}

TEST(MetThings, WhatTheBaseDroveOverSinceIsNotThere) {
  MetThings dut;
  dut.OnEcho({1, 0}, 0.3);
  EXPECT_TRUE(dut.Echoes({{0, 0, 0}, {0.9, 0.1, 0}}).empty());
}

TEST(MetThings, AStopStaysUntilAllIsForgotten) {
  MetThings dut;
  dut.OnStop({{1, 0, 0}, {0.2, 0.2}});
  EXPECT_EQ(dut.stops().size(), 1U);
  dut.Reset();
  EXPECT_TRUE(dut.stops().empty());
}

}  // namespace
}  // namespace priamos::planner
