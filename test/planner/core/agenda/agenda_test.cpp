#include "planner/core/agenda/agenda.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

#include "agenda_rig.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

TEST(Agenda, StepsAreDoneInTurnAndEachEndIsTold) {
  AgendaRig rig;
  const int id = rig.Order({Go(4, 1.5), Stand(5), Door(), Go(8, 1.5)});
  rig.robot.RunFor(300);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_THAT(rig.dut.state().text, HasSubstr("all 4 steps done in"));
  ASSERT_EQ(rig.dut.results().size(), 5u);
  for (int step = 1; step <= 4; ++step) {
    const AgendaResult& result = rig.dut.results()[std::size_t(step - 1)];
    EXPECT_EQ(result.order_id, id);
    EXPECT_EQ(result.step, step);
    EXPECT_EQ(result.end, AgendaEnd::kDone);
  }
  EXPECT_NEAR(rig.dut.results()[1].took_s, 5, 0.1);
  EXPECT_EQ(rig.last().step, 0);
  EXPECT_NEAR(rig.robot.truth().x, 8, 0.01);
}

TEST(Agenda, AFailedStepEndsTheOrderWithItsReasonAndCancelsWhatWaits) {
  AgendaRig rig;
  const int id = rig.Order({Go(3, 2.4), Door(9), Go(4, 2.4)});
  const int next = rig.Order({Go(2, 2.4)});
  rig.robot.RunFor(100);
  EXPECT_EQ(rig.dut.state().text, "step 2 (door '9'): the map has no door 9");
  EXPECT_EQ(rig.last().order_id, next);
  EXPECT_EQ(rig.last().end, AgendaEnd::kCancelled);
  EXPECT_EQ(rig.last().text, "order " + std::to_string(id) + " before it failed");
  rig.StepFor(20);
  EXPECT_NEAR(rig.robot.truth().x, 3, 0.01) << "nothing more is driven";
}

TEST(Agenda, OrdersWaitInTheirOrder) {
  AgendaRig rig;
  const int first = rig.Order({Go(4, 2.4)}), second = rig.Order({Go(3, 2.4)}), third = rig.Order({Stand(1)});
  EXPECT_EQ(rig.dut.order().id, first);
  ASSERT_EQ(rig.dut.waiting().size(), 2u);
  EXPECT_EQ(rig.dut.waiting()[0].title, "goto (3.00, 2.40)");
  rig.StepFor(60);
  ASSERT_EQ(rig.dut.results().size(), 3u);
  EXPECT_EQ(rig.dut.results()[0].order_id, first);
  EXPECT_EQ(rig.dut.results()[1].order_id, second);
  EXPECT_EQ(rig.dut.results()[2].order_id, third);
  EXPECT_NEAR(rig.robot.truth().x, 3, 0.01);
}

TEST(Agenda, AnOrderThatIsSaidAgainIsOneOrder) {
  AgendaRig rig;
  for (int i = 0; i < 3; ++i) rig.Order({Go(4, 2.4)}, 1, 77);
  EXPECT_TRUE(rig.dut.waiting().empty());
  rig.StepFor(30);
  EXPECT_FALSE(rig.dut.running());
  rig.Order({Go(4, 2.4)}, 1, 77);
  EXPECT_FALSE(rig.dut.running()) << "it is over";
  EXPECT_EQ(rig.dut.results().size(), 1u);
}

TEST(Agenda, APatrolGoesOnUntilItIsCancelled) {
  AgendaRig rig({1.5, 2.4, 0});
  const int id = rig.Order({Go(3, 2.4), Go(1.5, 2.4)}, 0);
  rig.StepFor(120);
  EXPECT_TRUE(rig.dut.running());
  EXPECT_GE(rig.dut.round(), 3);
  EXPECT_TRUE(rig.dut.Cancel(id));
  rig.StepFor(2);
  EXPECT_FALSE(rig.dut.running());
  EXPECT_EQ(rig.last().end, AgendaEnd::kCancelled);
  EXPECT_THAT(rig.last().text, HasSubstr("cancelled by the operator"));
  EXPECT_TRUE(rig.robot.paths.back().points.empty()) << "it brakes";
}

TEST(Agenda, ACancelledOrderMakesRoomForTheNextOne) {
  AgendaRig rig;
  const int first = rig.Order({Go(4, 2.4)}), second = rig.Order({Go(3, 2.4)}),
            third = rig.Order({Go(1.5, 2.4)});
  rig.StepFor(3);
  EXPECT_TRUE(rig.dut.Cancel(second));
  EXPECT_TRUE(rig.dut.Cancel(first));
  EXPECT_FALSE(rig.dut.Cancel(4321));
  rig.StepFor(1);
  EXPECT_EQ(rig.dut.order().id, third);
  rig.StepFor(30);
  EXPECT_NEAR(rig.robot.truth().x, 1.5, 0.01);
}

TEST(Agenda, AnAbortEndsAll) {
  AgendaRig rig;
  rig.Order({Go(4, 2.4)});
  rig.Order({Go(3, 2.4)});
  rig.StepFor(3);
  rig.dut.Abort(rig.robot.now());
  rig.StepFor(1);
  EXPECT_FALSE(rig.dut.running());
  EXPECT_TRUE(rig.dut.waiting().empty());
  EXPECT_EQ(rig.dut.state().text, "aborted by the operator");
  EXPECT_TRUE(rig.robot.paths.back().points.empty());
}

TEST(Agenda, PausedNothingBegins) {
  AgendaRig rig;
  EXPECT_FALSE(rig.dut.Pause(rig.robot.now())) << "nothing is under way";
  rig.Order({Stand(5), Go(4, 2.4)});
  rig.StepFor(2);
  EXPECT_TRUE(rig.dut.Pause(rig.robot.now()));
  rig.Order({Go(3, 2.4)});
  rig.StepFor(60);
  EXPECT_EQ(rig.dut.step(), 1) << "the wait stands still";
  for (const PathOrder& path : rig.robot.paths) EXPECT_TRUE(path.points.empty());
  EXPECT_TRUE(rig.dut.Resume(rig.robot.now()));
  rig.StepFor(2);
  EXPECT_EQ(rig.dut.step(), 1) << "3 s are left";
  rig.StepFor(60);
  EXPECT_NEAR(rig.robot.truth().x, 3, 0.01);
}

/// Pressed and re-armed while the robot stands between two drives, where no mission is under way.
TEST(Agenda, AnEmergencyStopBetweenTwoStepsEndsTheOrder) {
  AgendaRig rig;
  rig.Order({Stand(5), Go(4, 2.4)});
  rig.StepFor(1);
  rig.missions.OnDrive({.mode = DriveMode::kIdle, .limit = "", .estop_changes = 2}, rig.robot.now());
  rig.dut.Tick(rig.robot.now());
  EXPECT_FALSE(rig.dut.running());
  EXPECT_THAT(rig.dut.state().text, HasSubstr("pressed or lifted since the order"));
}

TEST(Agenda, WhatCannotBeCarriedOutIsRefusedAndRemembered) {
  AgendaRig rig;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](AgendaOrder order) {
    const auto refusal = rig.dut.Take(std::move(order), rig.robot.now());
    EXPECT_EQ(rig.last().end, AgendaEnd::kRefused);
    return refusal ? refusal->reason : "";
  };
  EXPECT_EQ(refused({5, "", {}, 1}), "an order has at least one step");
  EXPECT_EQ(refused({6, "", {{{7, 0, {}}, {}}}, 1}), "unknown mission 7");
  EXPECT_THAT(refused({7, "", {Go(nan, 1)}, 1}), HasSubstr("no place"));
  EXPECT_THAT(refused({8, "", {Go(1e9, 1)}, 1}), HasSubstr("no place"));
  EXPECT_THAT(refused({9, "", {Stand(nan)}, 1}), HasSubstr("seconds"));
  EXPECT_THAT(refused({10, "", {Stand(1)}, -1}), HasSubstr("rounds"));
  EXPECT_THAT(refused({11, "", std::vector<AgendaStep>(33, Stand(1)), 1}), HasSubstr("at most 32 steps"));
  EXPECT_FALSE(rig.dut.running());
  for (int i = 0; i < 9; ++i) rig.dut.Take({100 + i, "", {Stand(1)}, 1}, rig.robot.now());
  EXPECT_THAT(refused({200, "", {Stand(1)}, 1}), HasSubstr("8 orders wait already"));
}

TEST(Agenda, TheTimeLeftCountsTheStepsToCome) {
  AgendaRig rig;
  rig.Order({Go(4, 1.5), Stand(20), Go(2, 2.4)});
  rig.StepFor(1);
  const Time then = rig.robot.now();
  const auto left_s = rig.dut.Left_s(then);
  ASSERT_TRUE(left_s);
  rig.robot.RunFor(200);
  const double took_s = Seconds(rig.robot.now() - then);
  EXPECT_NEAR(*left_s, took_s, 0.3 * took_s);
}

TEST(Agenda, APauseEndsWithTheOrderThatItHeld) {
  AgendaRig rig({2.0, 2.4, 0}, ShippedPlan(), {.blackout_s = 20});
  rig.Order({Go(2.7, 2.4)});
  rig.robot.silent = true;
  rig.StepFor(12);
  rig.dut.Pause(rig.robot.now());
  rig.StepFor(9);
  ASSERT_FALSE(rig.dut.running()) << "it failed in the blackout";
  rig.robot.silent = false;
  rig.Order({Stand(0), Go(1.5, 2.4)});
  rig.StepFor(60);
  EXPECT_FALSE(rig.dut.running());
  EXPECT_EQ(rig.last().end, AgendaEnd::kDone);
  EXPECT_NEAR(rig.robot.truth().x, 1.5, 0.01);
}

/// Whatever people order, pause, cancel and lose on the radio: every order that was taken ends once, in their
/// order, and when all is over nothing is left to be driven.
RC_GTEST_PROP(Agenda, EveryOrderEndsOnce, ()) {
  AgendaRig rig({2.0, 2.4, 0}, ShippedPlan(), {.blackout_s = 20});
  std::vector<int> given;
  const int n = *rc::gen::inRange(1, 9);
  for (int i = 0; i < n; ++i) {
    switch (*rc::gen::inRange(0, 7)) {
      case 0:
      case 1:
        given.push_back(
            rig.Order({Stand(*rc::gen::inRange(0, 4)), Go(1.5 + *rc::gen::inRange(0, 30) / 10.0, 2.4)}));
        break;
      case 2:
        given.push_back(rig.Order({Stand(*rc::gen::inRange(0, 4))}, *rc::gen::inRange(1, 3)));
        break;
      case 3:
        rig.dut.Pause(rig.robot.now());
        break;
      case 4:
        rig.dut.Resume(rig.robot.now());
        break;
      case 5:
        if (!given.empty()) rig.dut.Cancel(given[*rc::gen::inRange<std::size_t>(0, given.size())]);
        break;
      default:
        rig.robot.silent = *rc::gen::arbitrary<bool>();
    }
    rig.StepFor(*rc::gen::inRange(0, 60) / 10.0);
  }
  rig.robot.silent = false;
  rig.dut.Resume(rig.robot.now());
  for (int i = 0; i < 40 && (rig.dut.running() || !rig.dut.waiting().empty()); ++i) rig.StepFor(10);
  RC_ASSERT(!rig.dut.running());
  RC_ASSERT(rig.dut.waiting().empty());
  std::vector<int> ended;
  for (const AgendaResult& result : rig.dut.results())
    if (result.step == 0) ended.push_back(result.order_id);
  std::sort(ended.begin(), ended.end());
  std::sort(given.begin(), given.end());
  RC_ASSERT(ended == given);
}

}  // namespace
}  // namespace priamos::planner
