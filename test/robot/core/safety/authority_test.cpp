#include "robot/core/safety/authority.hpp"

#include <gmock/gmock.h>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using Wish = Lease::Wish;

constexpr Time kStart = FromUtime(1'000'000'000);
const LeaseHolder kTeleop{Driver::kTeleop, 3}, kConsole{Driver::kConsole, 4};

class AuthorityTest : public testing::Test {
 protected:
  CommandVerdict Send(const LeaseHolder& from, double vx) {
    return dut_.Admit({now_, from, ++sequence_, milliseconds(200), {vx, 0, 0}}, now_);
  }
  void Take(const LeaseHolder& who) {
    dut_.Request(who, Wish::kTakeOver, now_);
    Send(who, 0);
  }
  void Wait(milliseconds time, bool path_is_driven = false) {
    for (milliseconds done{}; done < time; done += milliseconds(20)) {
      now_ += milliseconds(20);
      dut_.Tick(now_, path_is_driven);
    }
  }

  Time now_ = kStart;
  int sequence_ = 0;
  Authority dut_{AuthorityConfig{}};
};

TEST_F(AuthorityTest, APathTakesAFreeLeaseForThePlannerAndKeepsItWhileDriven) {
  EXPECT_TRUE(dut_.AdmitPath(now_));
  EXPECT_EQ(dut_.holder().driver, Driver::kPlanner);
  Wait(milliseconds(10'000), true);
  EXPECT_EQ(dut_.holder().driver, Driver::kPlanner);
  Wait(milliseconds(4'000), false);
  EXPECT_EQ(dut_.holder().driver, Driver::kNobody);
  EXPECT_FALSE(dut_.lease_lost()) << "nobody drove";
}

TEST_F(AuthorityTest, ADrivenPathDoesNotKeepTheLeaseOfAnOperator) {
  Take(kTeleop);
  Wait(milliseconds(4'000), true);
  EXPECT_EQ(dut_.holder().driver, Driver::kNobody);
}

TEST_F(AuthorityTest, APathIsRefusedWhileAnOperatorHoldsTheLease) {
  Take(kTeleop);
  EXPECT_FALSE(dut_.AdmitPath(now_));
}

TEST_F(AuthorityTest, AnOperatorWithoutLeaseIsRefused) {
  EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kWithoutLease);
  EXPECT_FALSE(dut_.Wish(now_));
}

TEST_F(AuthorityTest, TakingOverFromADrivenPathIsALossForThePlanner) {
  dut_.AdmitPath(now_);
  Wait(milliseconds(100), true);
  dut_.Request(kTeleop, Wish::kTakeOver, now_);
  EXPECT_TRUE(dut_.lease_lost());
  dut_.Forget();
  EXPECT_FALSE(dut_.lease_lost());
}

TEST_F(AuthorityTest, TakingOverFromAnOperatorInMotionEndsHisCommand) {
  Take(kConsole);
  Send(kConsole, 0.3);
  ASSERT_TRUE(dut_.Wish(now_));
  dut_.Request(kTeleop, Wish::kTakeOver, now_);
  EXPECT_TRUE(dut_.lease_lost());
  EXPECT_FALSE(dut_.Wish(now_));
  EXPECT_EQ(Send(kConsole, 0.3), CommandVerdict::kWithoutLease);
}

TEST_F(AuthorityTest, TheNewHoldersStickMustHaveRestedOnce) {
  dut_.Request(kTeleop, Wish::kAcquire, now_);
  EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kNotAtRest);
  EXPECT_EQ(Send(kTeleop, 0), CommandVerdict::kAccepted);
  EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kAccepted);
  EXPECT_EQ(dut_.Wish(now_)->vx, 0.3);
}

TEST_F(AuthorityTest, EstopChangesAreCountedFromTheSecondOfTheStart) {
  dut_.CountEstopChangesFrom(FromUtime(511'900'000));
  EXPECT_EQ(dut_.estop_changes(), 255);
  dut_.PressEstop();
  EXPECT_EQ(dut_.estop_changes(), 0);
  dut_.CountEstopChangesFrom(FromUtime(512'000'000));
  EXPECT_EQ(dut_.estop_changes(), 0);
  dut_.Rearm();
  EXPECT_EQ(dut_.estop_changes(), 1);
}

TEST_F(AuthorityTest, EstopLatchesAndAsksForRestAfterRearming) {
  Take(kTeleop);
  Send(kTeleop, 0.3);
  dut_.PressEstop();
  EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kNotAtRest);
  EXPECT_FALSE(dut_.AdmitPath(now_));
  Wait(milliseconds(1000));
  EXPECT_TRUE(dut_.estop());
  dut_.Rearm();
  EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kNotAtRest);
  EXPECT_EQ(Send(kTeleop, 0), CommandVerdict::kAccepted);
}

TEST_F(AuthorityTest, AHandThatRestsKeepsTheLeaseThroughAnEstopAndMovesNothingBeforeItRestsAgain) {
  Take(kTeleop);
  dut_.PressEstop();
  for (int i = 0; i < 100; ++i) {
    Wait(milliseconds(100));
    EXPECT_EQ(Send(kTeleop, 0), CommandVerdict::kAccepted);
    EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kNotAtRest);
  }
  EXPECT_EQ(dut_.holder(), kTeleop);
  EXPECT_EQ(dut_.Request(kConsole, Wish::kAcquire, now_), Lease::Answer::kRefused);
  dut_.Rearm();
  EXPECT_EQ(Send(kTeleop, 0.3), CommandVerdict::kNotAtRest);
  EXPECT_EQ(Send(kTeleop, 0), CommandVerdict::kAccepted);
}

TEST_F(AuthorityTest, ASessionWithTheNumberOfOneBeforeCountsFromItsOwnBeginning) {
  Take(kConsole);
  for (int i = 0; i < 1000; ++i) Send(kConsole, 0);
  Wait(milliseconds(4'000));
  ASSERT_EQ(dut_.holder().driver, Driver::kNobody);
  sequence_ = 0;  // the process starts again
  Take(kConsole);
  EXPECT_EQ(Send(kConsole, 0), CommandVerdict::kAccepted);
  EXPECT_EQ(Send(kConsole, 0.3), CommandVerdict::kAccepted);
}

TEST_F(AuthorityTest, CommandsKeepTheLeaseAlive) {
  Take(kTeleop);
  for (int i = 0; i < 100; ++i) {
    Wait(milliseconds(100));
    Send(kTeleop, 0.1);
  }
  EXPECT_EQ(dut_.holder(), kTeleop);
  Wait(milliseconds(3'200));
  EXPECT_EQ(dut_.holder().driver, Driver::kNobody);
}

}  // namespace
}  // namespace priamos::robot
