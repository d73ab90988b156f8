#include "bus/clocks/age_watch.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Verdict = AgeWatch::Verdict;

constexpr Time kBegin{std::chrono::hours(480'000)};
constexpr Duration kUncertainty = milliseconds(1);

/// One channel of one sender, whose messages are 30 ms old at most when they come.
class AgeWatchTest : public testing::Test {
 protected:
  AgeWatchTest() {
    for (int i = 0; i < 100; ++i) dut_.Note(1, "POSE", milliseconds(i % 31), now_ += milliseconds(50));
  }
  Verdict Judge(Duration age, Duration waited = Duration{}) const {
    return dut_.Judge(1, "POSE", age, kUncertainty, waited);
  }
  Time now_ = kBegin;
  AgeWatch dut_;
};

TEST_F(AgeWatchTest, AStampOfTheFutureIsOfNoClockThatWasMeasured) {
  EXPECT_EQ(Judge(-kUncertainty - AgeWatch::kJump), Verdict::kUsual);
  EXPECT_EQ(Judge(-kUncertainty - AgeWatch::kJump - Duration(1)), Verdict::kFuture);
  EXPECT_EQ(dut_.Judge(2, "NEVER_HEARD", -seconds(1), kUncertainty, seconds(9)), Verdict::kFuture);
}

TEST_F(AgeWatchTest, WhatIsOlderThanAllOfItsKindIsNoticed) {
  EXPECT_EQ(Judge(milliseconds(50)), Verdict::kUsual);
  EXPECT_EQ(Judge(milliseconds(51)), Verdict::kOlder);
  EXPECT_EQ(Judge(seconds(1)), Verdict::kOlder);
  EXPECT_EQ(dut_.Judge(1, "LANDMARK_FIX", seconds(1), kUncertainty, Duration{}), Verdict::kUsual)
      << "the first of its kind";
}

TEST_F(AgeWatchTest, WhatWaitedHereIsNotOlder) {
  EXPECT_EQ(Judge(milliseconds(330), milliseconds(300)), Verdict::kUsual);
  EXPECT_EQ(Judge(milliseconds(130), -seconds(1)), Verdict::kOlder) << "our own clock went back";
}

TEST_F(AgeWatchTest, AnAgeIsUsualForAWhile) {
  dut_.Note(1, "POSE", milliseconds(500), now_);
  for (Time end = now_ + AgeWatch::kRemembered / 2; now_ < end; now_ += milliseconds(50)) {
    EXPECT_EQ(Judge(milliseconds(510)), Verdict::kUsual);
    dut_.Note(1, "POSE", milliseconds(1), now_);
  }
  for (Time end = now_ + AgeWatch::kRemembered; now_ < end; now_ += milliseconds(50))
    dut_.Note(1, "POSE", milliseconds(1), now_);
  EXPECT_EQ(Judge(milliseconds(510)), Verdict::kOlder);
}

TEST_F(AgeWatchTest, AnybodyMaySend) {
  for (std::uint64_t i = 0; i < 2 * AgeWatch::kMostKinds; ++i) dut_.Note(i, "X", milliseconds(1), now_);
  EXPECT_EQ(dut_.Judge(2 * AgeWatch::kMostKinds - 1, "X", seconds(9), kUncertainty, Duration{}),
            Verdict::kUsual);
  EXPECT_EQ(Judge(milliseconds(51)), Verdict::kOlder);
}

}  // namespace
}  // namespace priamos::bus
