// Stories of hands at pages: who has the stick, and what the pilot sees and sends of it.

#include "console/core/seat.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "common/pilot/pilot.hpp"

namespace priamos::console {
namespace {

using std::chrono::milliseconds;

StickReport Forward(double deflection = 1) {
  StickReport report;
  report.axis[0] = deflection;
  report.hold = true;
  return report;
}

/// Pages, their seat, the pilot and a robot that grants every lease and obeys every stop.
class SeatTest : public testing::Test {
 protected:
  SeatTest() { dut_.Join(1); }

  /// One step of 10 ms in which every hand in `hands` reports.
  void Step(const std::map<ClientId, StickReport>& hands) {
    now_ += milliseconds(10);
    for (const auto& [page, report] : hands) dut_.Take(page, report, age_, now_);
    robot_.heard = now_;
    const PilotOutput output = pilot_.Step(dut_.Look(now_), robot_, now_);
    if (output.lease) robot_.lease = RobotView::Lease::kMine;
    if (output.lease == PilotOutput::Lease::kTakeOver) ++take_overs_;
    if (output.drive) wish_ = output.drive->vx;
    if (output.estop == PilotOutput::Estop::kRearm) ++rearms_;
  }
  void Run(double seconds, const std::map<ClientId, StickReport>& hands) {
    for (int i = 0; i < seconds * 100; ++i) Step(hands);
  }
  void DriveWith(ClientId page) {
    Run(0.1, {{page, {}}});
    Run(0.5, {{page, Forward()}});
    ASSERT_GT(wish_, 0);
  }

  Seat dut_{PilotConfig{}, milliseconds(250)};
  Pilot pilot_{PilotConfig{}};
  RobotView robot_;
  Time now_{std::chrono::seconds(100)};
  double wish_ = 0;
  Duration age_{};  ///< of what pages say
  int take_overs_ = 0, rearms_ = 0;
};

TEST_F(SeatTest, AHandThatLetGoOnceDrivesAndStopsWhenItRests) {
  DriveWith(1);
  EXPECT_EQ(dut_.holder(), 1u);
  Run(0.05, {{1, {}}});
  EXPECT_EQ(wish_, 0);
}

TEST_F(SeatTest, AKeyThatIsHeldWhileThePageConnectsMovesNothing) {
  Run(3, {{1, Forward()}});
  EXPECT_EQ(wish_, 0);
  EXPECT_FALSE(dut_.holder());
  DriveWith(1);
}

TEST_F(SeatTest, APageThatIsGoneStandsAtOnceAndItsSuccessorMustLetGo) {
  DriveWith(1);
  dut_.Leave(1);
  Step({});
  EXPECT_EQ(wish_, 0);
  dut_.Join(2);
  Run(2, {{2, Forward()}});
  EXPECT_EQ(wish_, 0) << "the key is still held";
  DriveWith(2);
}

TEST_F(SeatTest, AHandThatFallsSilentStandsAndMustLetGo) {
  DriveWith(1);
  Run(0.2, {});
  EXPECT_EQ(wish_, 0) << "0.15 s are over";
  Run(0.2, {});
  Run(2, {{1, Forward()}});
  EXPECT_EQ(wish_, 0);
  DriveWith(1);
}

TEST_F(SeatTest, WhatIsDelayedIsObeyedNoLongerThanItIsFresh) {
  DriveWith(1);
  for (int i = 0; i < 24; ++i) {
    age_ = milliseconds(10 * i);
    Step({{1, Forward()}});
    EXPECT_GT(wish_, 0) << age_.count();
  }
  for (int i = 25; i < 60; ++i) {
    age_ = milliseconds(10 * i);
    Step({{1, Forward()}});
  }
  EXPECT_EQ(wish_, 0);
  // All that waited arrives at once, and the way is free again: the hand was silent for too long.
  age_ = {};
  Run(1, {{1, Forward()}});
  EXPECT_EQ(wish_, 0);
  DriveWith(1);
}

TEST_F(SeatTest, AnOldReportIsObeyedUntilItIsStaleThoughItHasJustCome) {
  DriveWith(1);
  age_ = milliseconds(200);
  Step({{1, Forward()}});
  for (int i = 0; i < 7; ++i) Step({});
  EXPECT_EQ(wish_, 0) << "0.25 s old";
}

TEST_F(SeatTest, ASecondPageGetsTheSeatWhenTheFirstHasRested) {
  dut_.Join(2);
  DriveWith(1);
  Run(1, {{1, Forward()}, {2, {}}});
  Run(1, {{1, Forward()}, {2, Forward(-1)}});
  EXPECT_GT(wish_, 0) << "it is taken";
  Run(2.1, {{1, {}}, {2, {}}});
  Run(0.5, {{1, {}}, {2, Forward(-1)}});
  EXPECT_LT(wish_, 0);
  EXPECT_EQ(dut_.holder(), 2u);
}

TEST_F(SeatTest, ASecondPageTakesOverAndMustLetGoFirst) {
  dut_.Join(2);
  DriveWith(1);
  Run(0.1, {{1, Forward()}, {2, {}}});
  StickReport take_over = Forward(-1);
  take_over.take_over = true;
  Run(0.2, {{1, Forward()}, {2, take_over}});
  EXPECT_EQ(dut_.holder(), 2u);
  EXPECT_EQ(wish_, 0) << "neither the one nor the other";
  Run(0.5, {{1, Forward()}, {2, Forward(-1)}});
  EXPECT_EQ(wish_, 0);
  Run(0.1, {{1, Forward()}, {2, {}}});
  Run(0.5, {{1, Forward()}, {2, Forward(-1)}});
  EXPECT_LT(wish_, 0);
}

TEST_F(SeatTest, AShortPressIsSeenOnce) {
  Run(0.1, {{1, {}}});
  StickReport pressed;
  pressed.take_over = true;
  now_ += milliseconds(10);
  dut_.Take(1, pressed, age_, now_);
  Run(0.5, {{1, {}}});
  EXPECT_EQ(take_overs_, 1);
}

TEST_F(SeatTest, AfterAStopEverybodyMustLetGo) {
  DriveWith(1);
  dut_.End();
  Run(1, {{1, Forward()}});
  EXPECT_EQ(wish_, 0);
  DriveWith(1);
}

TEST_F(SeatTest, RearmingTakesASecondOfHolding) {
  robot_.estop = true;
  Run(0.1, {{1, {}}});
  StickReport rearm;
  rearm.rearm = true;
  Run(0.8, {{1, rearm}});
  EXPECT_EQ(rearms_, 0);
  Run(0.4, {{1, rearm}});
  EXPECT_EQ(rearms_, 1);
}

TEST_F(SeatTest, AStrangerMovesNothing) {
  Run(1, {{77, {}}});
  Run(1, {{77, Forward()}});
  EXPECT_EQ(wish_, 0);
}

/// Whatever pages do: what the pilot sees deflected was deflected by the holder's newest report, and the
/// holder has been seen at rest since it joined or the last stop.
RC_GTEST_PROP(SeatProperty, NobodyMovesWhoWasNotSeenAtRest, ()) {
  Seat dut{PilotConfig{}, milliseconds(250)};
  Time now{std::chrono::seconds(100)};
  std::map<ClientId, bool> rested;
  std::map<ClientId, StickReport> newest;
  for (int i = 0; i < 60; ++i) {
    now += milliseconds(*rc::gen::inRange(0, 400));
    const auto page = *rc::gen::inRange<ClientId>(1, 4);
    switch (*rc::gen::inRange(0, 6)) {
      case 0:
        if (rested.contains(page)) break;
        dut.Join(page);
        rested[page] = false;
        break;
      case 1:
        dut.Leave(page);
        rested.erase(page);
        break;
      case 2:
        dut.End();
        for (auto& [other, has] : rested) has = false;
        break;
      default: {
        StickReport report = *rc::gen::arbitrary<bool>() ? Forward() : StickReport{};
        report.take_over = *rc::gen::inRange(0, 4) == 0;
        if (!report.hold && rested.contains(page)) rested[page] = true;
        newest[page] = report;
        dut.Take(page, report, {}, now);
      }
    }
    const Stick stick = dut.Look(now);
    if (stick.axis[0] == 0 && (stick.buttons & 1u) == 0) continue;
    RC_ASSERT(dut.holder().has_value());
    RC_ASSERT(rested.contains(*dut.holder()) && rested.at(*dut.holder()));
    RC_ASSERT(newest.at(*dut.holder()).hold);
  }
}

}  // namespace
}  // namespace priamos::console
