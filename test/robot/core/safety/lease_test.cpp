#include "robot/core/safety/lease.hpp"

#include <gmock/gmock.h>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using Wish = Lease::Wish;
using Answer = Lease::Answer;

constexpr Time kStart = FromUtime(1'000'000'000);
const LeaseHolder kPlanner{Driver::kPlanner, 1}, kConsole{Driver::kConsole, 2}, kTeleop{Driver::kTeleop, 3},
    kOtherTeleop{Driver::kTeleop, 4};

class LeaseTest : public testing::Test {
 protected:
  Lease dut_{LeaseConfig{.keep_s = 3}};
};

TEST_F(LeaseTest, IsFreeAtFirstAndGrantedToWhoeverAsks) {
  EXPECT_EQ(dut_.holder().driver, Driver::kNobody);
  EXPECT_EQ(dut_.Request(kPlanner, Wish::kAcquire, kStart), Answer::kGranted);
  EXPECT_TRUE(dut_.IsHeldBy(kPlanner));
}

TEST_F(LeaseTest, AHigherRankDoesNotGetItByAccident) {
  dut_.Request(kPlanner, Wish::kAcquire, kStart);
  EXPECT_EQ(dut_.Request(kTeleop, Wish::kAcquire, kStart), Answer::kRefused);
  EXPECT_TRUE(dut_.IsHeldBy(kPlanner));
}

TEST_F(LeaseTest, AHigherRankTakesItOverExplicitly) {
  dut_.Request(kPlanner, Wish::kAcquire, kStart);
  EXPECT_EQ(dut_.Request(kTeleop, Wish::kTakeOver, kStart), Answer::kGranted);
  EXPECT_FALSE(dut_.IsHeldBy(kPlanner));
}

TEST_F(LeaseTest, ALowerRankCannotTakeItOver) {
  dut_.Request(kTeleop, Wish::kAcquire, kStart);
  EXPECT_EQ(dut_.Request(kConsole, Wish::kTakeOver, kStart), Answer::kRefused);
  EXPECT_EQ(dut_.Request(kPlanner, Wish::kTakeOver, kStart), Answer::kRefused);
  EXPECT_TRUE(dut_.IsHeldBy(kTeleop));
}

TEST_F(LeaseTest, TheSameRankTakesItOverExplicitly) {
  dut_.Request(kTeleop, Wish::kAcquire, kStart);
  EXPECT_EQ(dut_.Request(kOtherTeleop, Wish::kAcquire, kStart), Answer::kRefused);
  EXPECT_EQ(dut_.Request(kOtherTeleop, Wish::kTakeOver, kStart), Answer::kGranted);
}

TEST_F(LeaseTest, OnlyItsHolderReleasesIt) {
  dut_.Request(kConsole, Wish::kAcquire, kStart);
  EXPECT_EQ(dut_.Request(kTeleop, Wish::kRelease, kStart), Answer::kRefused);
  EXPECT_EQ(dut_.Request(kConsole, Wish::kRelease, kStart), Answer::kReleased);
  EXPECT_EQ(dut_.holder().driver, Driver::kNobody);
}

TEST_F(LeaseTest, ASilentHolderLosesIt) {
  dut_.Request(kTeleop, Wish::kAcquire, kStart);
  dut_.Expire(kStart + milliseconds(2900));
  EXPECT_TRUE(dut_.IsHeldBy(kTeleop));
  dut_.Expire(kStart + milliseconds(3100));
  EXPECT_FALSE(dut_.IsHeldBy(kTeleop));
}

TEST_F(LeaseTest, ASignOfLifeRenewsItOnlyForItsHolder) {
  dut_.Request(kTeleop, Wish::kAcquire, kStart);
  dut_.Renew(kTeleop, kStart + milliseconds(2000));
  dut_.Expire(kStart + milliseconds(4900));
  EXPECT_TRUE(dut_.IsHeldBy(kTeleop));
  dut_.Renew(kPlanner, kStart + milliseconds(4900));
  dut_.Expire(kStart + milliseconds(5100));
  EXPECT_FALSE(dut_.IsHeldBy(kTeleop));
}

TEST_F(LeaseTest, NobodyIsNotADriver) {
  EXPECT_EQ(dut_.Request({}, Wish::kTakeOver, kStart), Answer::kRefused);
  EXPECT_FALSE(dut_.IsHeldBy({}));
}

}  // namespace
}  // namespace priamos::robot
