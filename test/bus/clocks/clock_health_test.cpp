#include "bus/clocks/clock_health.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "bus/schema/packing.hpp"
#include "bus/wire/typed_message.hpp"

namespace priamos::bus {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::seconds;

health_t With(const std::optional<ClockDifference>& ahead) {
  health_t message{};
  SetClock(message, ahead);
  return message;
}

TEST(ClockHealth, SaysHowFarTheClockIsAheadAndHowExactlyThatIsKnown) {
  const health_t dut = With(ClockDifference{microseconds(-100'200), microseconds(300)});
  EXPECT_DOUBLE_EQ(dut.clock_ahead_s, -0.1002);
  EXPECT_DOUBLE_EQ(dut.clock_uncertainty_s, 0.0003);
}

TEST(ClockHealth, WhatIsNotKnownToASecondIsNotKnown) {
  for (const auto& ahead :
       {std::optional<ClockDifference>(), std::optional(ClockDifference{hours(1), seconds(2)})}) {
    EXPECT_EQ(With(ahead).clock_ahead_s, 0);
    EXPECT_EQ(With(ahead).clock_uncertainty_s, -1);
  }
}

TEST(ClockHealth, CrossesTheRadioWithoutSaturation) {
  const Schema schema = OwnTypes();
  const Packer packer(*schema.Find("health_t"));
  for (const auto& ahead :
       {std::optional<ClockDifference>(), std::optional(ClockDifference{-hours(24 * 365), {}}),
        std::optional(ClockDifference{hours(24 * 365), seconds(1)})}) {
    health_t message = With(ahead);
    message.utime = 1'000'000;
    const auto packed = packer.Pack(Encode(message), 1'000'000);
    ASSERT_TRUE(packed);
    EXPECT_TRUE(packed->saturated.empty());
  }
}

}  // namespace
}  // namespace priamos::bus
