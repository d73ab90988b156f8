#include "bus/clocks/clock_offset.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kBegin{std::chrono::hours(480'000)};

/// A clock that was ahead by `ahead` at kBegin and gains `rate`.
struct OtherClock {
  Duration ahead{};
  double rate = 0;

  Time At(Time ours) const {
    return ours + ahead + Duration(std::llround(rate * static_cast<double>((ours - kBegin).count())));
  }
  TwoWayExchange Exchange(Time sent, Duration there, Duration waits, Duration back) const {
    return {sent, At(sent + there), At(sent + there + waits), sent + there + waits + back};
  }
};

TEST(ClockOffset, NothingIsKnownBeforeTheFirstExchange) {
  EXPECT_FALSE(ClockOffset().At(kBegin));
}

TEST(ClockOffset, EqualWaysGiveTheDifferenceExactly) {
  ClockOffset dut;
  const OtherClock other{seconds(-3600)};
  ASSERT_TRUE(dut.Add(other.Exchange(kBegin, milliseconds(3), milliseconds(400), milliseconds(3))));
  const auto difference = dut.At(kBegin + milliseconds(406));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->ahead, seconds(-3600));
  EXPECT_NEAR(Seconds(difference->uncertainty), 0.003, 0.0002);
}

TEST(ClockOffset, TheQuickestExchangeCounts) {
  ClockOffset dut;
  const OtherClock other{seconds(1)};
  dut.Add(other.Exchange(kBegin, milliseconds(1), {}, milliseconds(1)));
  dut.Add(other.Exchange(kBegin + seconds(1), milliseconds(90), {}, milliseconds(1)));
  EXPECT_EQ(dut.At(kBegin + seconds(2))->ahead, seconds(1));
}

TEST(ClockOffset, WhatIsLongAgoIsLessCertain) {
  ClockOffset dut;
  dut.Add(OtherClock{}.Exchange(kBegin, {}, {}, {}));
  EXPECT_LT(dut.At(kBegin + seconds(1))->uncertainty, milliseconds(1));
  EXPECT_GT(dut.At(kBegin + seconds(200))->uncertainty, milliseconds(39));
}

TEST(ClockOffset, AnImpossibleExchangeIsRefused) {
  ClockOffset dut;
  const Time t = kBegin;
  EXPECT_FALSE(dut.Add({t, t, t - milliseconds(1), t}));                        // answered before it arrived
  EXPECT_FALSE(dut.Add({t, t, t, t - milliseconds(1)}));                        // heard before it was sent
  EXPECT_FALSE(dut.Add({t, t, t + milliseconds(500), t + milliseconds(400)}));  // a way of less than nothing
  EXPECT_FALSE(dut.Add({t, t, t, t + ClockOffset::kLongest + milliseconds(1)}));
  EXPECT_FALSE(dut.At(t));
}

/// One second of a wall clock's error, slewed by chrony's 8.3 %, once a second measured: NTP sets the rate of
/// the clock that our stamps are of.
TEST(ClockOffset, WhatNtpSlewsIsFollowedAndMoreUncertainUntilItIsOver) {
  ClockOffset dut;
  constexpr double kSlew = 0.083;
  const OtherClock before{}, slewed{{}, kSlew}, after{milliseconds(996)};
  Time now = kBegin - seconds(40);
  for (; now < kBegin; now += seconds(1)) dut.Add(before.Exchange(now, Duration(100), {}, Duration(100)));
  EXPECT_LT(dut.At(now)->uncertainty, milliseconds(2));
  for (; now < kBegin + seconds(12); now += milliseconds(50)) {
    dut.Add(slewed.Exchange(now, milliseconds(1), {}, milliseconds(1)));
    const Time then = now + milliseconds(40);
    const Duration error = slewed.At(then) - then - dut.At(then)->ahead;
    EXPECT_LT(std::chrono::abs(error), milliseconds(6));
    EXPECT_TRUE(now <= kBegin + milliseconds(50) || dut.unsteady());
    if (now > kBegin + milliseconds(200)) {
      EXPECT_LE(std::chrono::abs(error), dut.At(then)->uncertainty);
    }
  }
  for (; now < kBegin + seconds(32); now += seconds(1))
    dut.Add(after.Exchange(now, milliseconds(1), {}, milliseconds(1)));
  EXPECT_NEAR(Seconds(dut.At(now)->ahead), 0.996, 0.001);
  EXPECT_LT(dut.At(now)->uncertainty, milliseconds(2)) << "it is over";
  EXPECT_FALSE(dut.unsteady());
}

/// Whatever the ways take, however different, and however the clocks drift within 100 ppm each.
RC_GTEST_PROP(ClockOffsetProperty, TheTruthIsWithinTheUncertainty, ()) {
  ClockOffset dut;
  const OtherClock other{milliseconds(*rc::gen::inRange(-5'000'000, 5'000'000)),
                         1e-6 * *rc::gen::inRange(-190, 190)};
  const auto ways = *rc::gen::container<std::vector<std::pair<int, int>>>(
      60, rc::gen::pair(rc::gen::inRange(0, 400'000), rc::gen::inRange(0, 400'000)));
  Time now = kBegin;
  for (const auto& [there, back] : ways) {
    now += milliseconds(*rc::gen::inRange(0, 2000));
    const auto exchange =
        other.Exchange(now, Duration(there), milliseconds(*rc::gen::inRange(0, 1000)), Duration(back));
    now = exchange.heard;
    dut.Add(exchange);
    const auto difference = dut.At(now);
    if (!difference) continue;
    const Duration error = other.At(now) - now - difference->ahead;
    RC_ASSERT(std::chrono::abs(error) <= difference->uncertainty);
  }
}

}  // namespace
}  // namespace priamos::bus
