// Stories of a supervised process.

#include "cli/supervise/process_watch.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Action = ProcessWatch::Action;
using testing::HasSubstr;

class ProcessWatchTest : public testing::Test {
 protected:
  Action Step() { return dut_.Step(may_start_, may_stop_, now_); }
  /// Steps of 10 ms until something is to be done, at most `most`.
  Action Wait(Duration most) {
    const Time end = now_ + most;
    for (; now_ < end; now_ += milliseconds(10)) {
      if (alive_) dut_.SaidAlive(now_);
      if (const Action action = Step(); action != Action::kNone) return action;
    }
    return Action::kNone;
  }
  void Start() {
    ASSERT_EQ(Wait(seconds(40)), Action::kStart);
    dut_.Started(now_);
  }
  void BecomeReady() {
    Start();
    now_ += milliseconds(300);
    dut_.SaidReady(now_);
  }
  /// How long it waits after a failure.
  double BackOff() {
    dut_.Exited("exit code 1", now_);
    const Time begin = now_;
    EXPECT_EQ(Wait(seconds(60)), Action::kStart);
    const double waited_s = Seconds(now_ - begin);
    dut_.Started(now_);
    return waited_s;
  }

  ProcessWatch dut_{WatchPolicy{}};
  bool may_start_ = true, may_stop_ = true, alive_ = true;
  Time now_ = FromUtime(1'000'000);
};

TEST_F(ProcessWatchTest, WaitsForWhatItDependsOn) {
  may_start_ = false;
  EXPECT_EQ(Wait(seconds(5)), Action::kNone);
  EXPECT_EQ(dut_.state(), ProcessState::kWaiting);
  may_start_ = true;
  EXPECT_EQ(Step(), Action::kStart);
}

TEST_F(ProcessWatchTest, IsReadyWhenItSaysSo) {
  Start();
  EXPECT_EQ(dut_.state(), ProcessState::kStarting);
  dut_.SaidReady(now_);
  EXPECT_EQ(dut_.state(), ProcessState::kReady);
  EXPECT_EQ(Wait(seconds(60)), Action::kNone);
}

TEST_F(ProcessWatchTest, OneThatNeverGetsReadyIsKilledOnce) {
  Start();
  EXPECT_EQ(Wait(seconds(20)), Action::kKill);
  EXPECT_EQ(Wait(seconds(1)), Action::kNone) << "the kernel needs no second one";
  dut_.Exited("killed by signal 9", now_);
  EXPECT_THAT(dut_.reason(), HasSubstr("not ready within 10 s"));
}

TEST_F(ProcessWatchTest, OneThatHangsIsKilledAndStartedAgainWithinThreeSeconds) {
  BecomeReady();
  alive_ = false;
  const Time hung = now_;
  EXPECT_EQ(Wait(seconds(20)), Action::kKill);
  dut_.Exited("killed by signal 9", now_);
  EXPECT_THAT(dut_.reason(), HasSubstr("hung: silent for 1.0 s"));
  EXPECT_EQ(Wait(seconds(20)), Action::kStart);
  EXPECT_LT(now_ - hung, milliseconds(2200));
}

TEST_F(ProcessWatchTest, OneThatGetsNoProcessorIsNotSilent) {
  BecomeReady();
  alive_ = false;
  for (int i = 1; i <= 40; ++i) {
    dut_.SeenWaiting(i * milliseconds(80));
    ASSERT_EQ(Wait(milliseconds(100)), Action::kNone) << i;
  }
}

TEST_F(ProcessWatchTest, OneThatGetsNoProcessorForTooLongIsStartedAgain) {
  BecomeReady();
  alive_ = false;
  const Time silent = now_;
  Action action = Action::kNone;
  for (int i = 1; i <= 100 && action == Action::kNone; ++i) {
    dut_.SeenWaiting(i * milliseconds(100));
    action = Wait(milliseconds(100));
  }
  EXPECT_EQ(action, Action::kKill);
  EXPECT_NEAR(Seconds(now_ - silent), 5, 0.2);
}

TEST_F(ProcessWatchTest, WhatItWaitedBeforeItSpokeDoesNotCount) {
  BecomeReady();
  dut_.SeenWaiting(seconds(30));
  dut_.SaidAlive(now_);
  alive_ = false;
  const Time silent = now_;
  EXPECT_EQ(Wait(seconds(20)), Action::kKill);
  EXPECT_NEAR(Seconds(now_ - silent), 1, 0.02);
}

TEST_F(ProcessWatchTest, OneThatStartsOnABusyMachineHasMoreTime) {
  Start();
  for (int i = 1; i <= 20; ++i) {
    dut_.SeenWaiting(i * milliseconds(900));
    ASSERT_EQ(Wait(seconds(1)), Action::kNone) << i;
  }
}

TEST_F(ProcessWatchTest, OneThatIsStoppedNeedNotWaitForItsWatchdog) {
  BecomeReady();
  dut_.SeenStopped(true, now_);
  const Time stopped = now_;
  EXPECT_EQ(Wait(seconds(20)), Action::kKill) << "though what it had said before is still being read";
  EXPECT_NEAR(Seconds(now_ - stopped), 0.2, 0.02);
  dut_.Exited("killed by signal 9", now_);
  EXPECT_THAT(dut_.reason(), HasSubstr("hung: stopped for 0.2 s"));
  EXPECT_EQ(Wait(seconds(20)), Action::kStart);
  dut_.Started(now_);
  dut_.SaidReady(now_);
  EXPECT_EQ(Wait(seconds(5)), Action::kNone) << "the next one is not stopped";
}

TEST_F(ProcessWatchTest, OneThatStopsForAMomentGoesOn) {
  BecomeReady();
  for (int i = 0; i < 20; ++i) {
    dut_.SeenStopped(true, now_);
    EXPECT_EQ(Wait(milliseconds(150)), Action::kNone);
    dut_.SeenStopped(false, now_);
  }
}

TEST_F(ProcessWatchTest, BacksOffLongerAndLongerUpToHalfAMinute) {
  Start();
  for (const double expected_s : {1, 2, 4, 8, 16, 30, 30}) EXPECT_NEAR(BackOff(), expected_s, 0.05);
}

TEST_F(ProcessWatchTest, ThreeFailuresInARowRaiseTheAlarm) {
  Start();
  BackOff();
  BackOff();
  EXPECT_FALSE(dut_.alarm());
  BackOff();
  EXPECT_TRUE(dut_.alarm());
}

TEST_F(ProcessWatchTest, AStableRunForgetsTheFailures) {
  Start();
  for (int i = 0; i < 4; ++i) BackOff();
  dut_.SaidReady(now_);
  EXPECT_EQ(Wait(seconds(20)), Action::kNone);
  EXPECT_TRUE(dut_.alarm()) << "not yet stable";
  Wait(seconds(11));
  EXPECT_FALSE(dut_.alarm());
  EXPECT_NEAR(BackOff(), 1, 0.05);
}

TEST_F(ProcessWatchTest, ReadyForAMomentDoesNotCount) {
  for (int i = 0; i < 3; ++i) {
    BecomeReady();
    Wait(seconds(2));
    dut_.Exited("exit code 1", now_);
  }
  EXPECT_TRUE(dut_.alarm());
}

TEST_F(ProcessWatchTest, StopsWhenNothingNeedsItAnyMore) {
  BecomeReady();
  dut_.Stop();
  may_stop_ = false;
  EXPECT_EQ(Wait(seconds(1)), Action::kNone);
  may_stop_ = true;
  EXPECT_EQ(Step(), Action::kTerminate);
  dut_.Exited("exit code 0", now_);
  EXPECT_EQ(Wait(seconds(60)), Action::kNone) << "and stays stopped";
  EXPECT_EQ(dut_.state(), ProcessState::kStopped);
}

TEST_F(ProcessWatchTest, OneThatDoesNotStopIsKilled) {
  BecomeReady();
  dut_.Stop();
  EXPECT_EQ(Step(), Action::kTerminate);
  const Time asked = now_;
  EXPECT_EQ(Wait(seconds(10)), Action::kKill);
  EXPECT_NEAR(Seconds(now_ - asked), 2, 0.05);
}

TEST_F(ProcessWatchTest, OneThatDiesWhileStoppingIsNotStartedAgain) {
  BecomeReady();
  dut_.Stop();
  may_stop_ = false;
  dut_.Exited("killed by signal 9", now_);
  EXPECT_EQ(Wait(seconds(60)), Action::kNone);
}

TEST_F(ProcessWatchTest, IsStartedAgainByOrderWithoutAPauseAndWithoutBlame) {
  BecomeReady();
  may_stop_ = false;  // others depend on it; they go on
  dut_.Restart();
  EXPECT_EQ(Step(), Action::kTerminate);
  EXPECT_EQ(Step(), Action::kNone);
  dut_.Exited("exit code 0", now_);
  EXPECT_EQ(dut_.failures(), 0);
  EXPECT_THAT(dut_.reason(), HasSubstr("by order"));
  EXPECT_EQ(Step(), Action::kStart);
  dut_.Started(now_);
  EXPECT_EQ(dut_.starts(), 2);
  dut_.SaidReady(now_);
  EXPECT_EQ(Wait(milliseconds(500)), Action::kNone) << "once";
}

TEST_F(ProcessWatchTest, OneThatIsDeafToTheOrderIsKilled) {
  BecomeReady();
  dut_.Restart();
  EXPECT_EQ(Step(), Action::kTerminate);
  EXPECT_EQ(Wait(seconds(3)), Action::kKill);
  dut_.Exited("signal 9", now_);
  EXPECT_EQ(Step(), Action::kStart);
}

TEST_F(ProcessWatchTest, OneThatWaitsToBeStartedAgainIsStartedByOrderAtOnce) {
  BecomeReady();
  dut_.Exited("exit code 1", now_);
  EXPECT_EQ(Step(), Action::kNone);
  dut_.Restart();
  EXPECT_EQ(Step(), Action::kStart);
  dut_.Started(now_);
  dut_.Restart();
  dut_.Stop();
  EXPECT_EQ(Step(), Action::kTerminate);
  dut_.Exited("exit code 0", now_);
  EXPECT_EQ(dut_.state(), ProcessState::kStopped) << "an end is an end";
}

}  // namespace
}  // namespace priamos::cli
