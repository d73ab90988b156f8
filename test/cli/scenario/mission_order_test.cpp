#include "cli/scenario/mission_order.hpp"

#include <gmock/gmock.h>

#include <set>

#include "cli/scenario/door_name.hpp"
#include "common/archive.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using Status = mission_status_t;

mission_command_t Order(int mission, int order_id = 0) {
  mission_command_t order{};
  order.mission = static_cast<std::int8_t>(mission);
  order.landmark_id = 1;
  order.order_id = order_id;
  return order;
}

/// A planner without an order.
Status Idle() {
  Status status{};
  status.phase = Status::WAITING;
  status.text = "no order yet";
  return status;
}

/// One that carries out an order.
Status Runs(int order_id, int phase, const std::string& text) {
  Status status{};
  status.phase = static_cast<std::int8_t>(phase);
  status.text = text;
  status.order_id = order_id;
  status.running = true;
  status.step = status.n_steps = 1;
  return status;
}

/// One that has ended an order so.
Status Ended(int order_id, int outcome, const std::string& text) {
  Status status = Idle();
  mission_result_t result{};
  result.order_id = order_id;
  result.outcome = static_cast<std::int8_t>(outcome);
  result.text = text;
  status.results.push_back(result);
  status.n_results = 1;
  return status;
}

Status AndWaits(Status status, int order_id) {
  mission_waiting_t waiting{};
  waiting.order_id = order_id;
  status.waiting.push_back(waiting);
  status.n_waiting = static_cast<std::int8_t>(status.waiting.size());
  return status;
}

constexpr int kOrder = 7;

/// A planner that speaks twice a second, and somebody who gives it an order.
struct Talk {
  explicit Talk(int mission = mission_command_t::PASS_DOOR, bool to_the_end = false, int order_id = kOrder)
      : dut(Order(mission, order_id), to_the_end, 1) {}
  explicit Talk(const MissionOrder& order) : dut(order) {}

  /// The planner says this for so long. Returns what a person was told.
  std::vector<std::string> For(double seconds, const Status& status) {
    std::vector<std::string> told;
    for (const Time until = now + FromSeconds(seconds); now < until; now += FromSeconds(0.05), ++steps) {
      if (steps % 10 == 0)
        if (const auto text = dut.Hear(status, now)) told.push_back(*text);
      if (robot && steps % 10 == 0) dut.Hear(*robot, now);
      if (dut.Step(now)) ++orders;
    }
    return told;
  }
  void Silence(double seconds) {
    for (const Time until = now + FromSeconds(seconds); now < until; now += FromSeconds(0.05))
      if (dut.Step(now)) ++orders;
  }

  /// The planner has ordered the robot to stand, and the robot does so.
  void Stands() {
    dut.Hear(path_t{});
    robot = drive_status_t{};
    robot->mode = drive_status_t::HOLDING;
  }

  MissionOrder dut;
  std::optional<drive_status_t> robot;
  Time now = FromUtime(5'000'000);
  int steps = 0, orders = 0;
};

/// An order with this outcome, the last words of which are `text`.
auto Came(OrderOutcome outcome, const testing::Matcher<std::string>& text) {
  return testing::AllOf(testing::Property("outcome", &MissionOrder::outcome, outcome),
                        testing::Property("text", &MissionOrder::text, text));
}

TEST(MissionOrder, IsAcceptedWhenTheRobotIsUnderWay) {
  Talk talk;
  talk.For(0.6, Idle());
  EXPECT_EQ(talk.orders, 1);
  EXPECT_THAT(talk.For(0.6, Runs(kOrder, Status::WAITING, "waiting for the robot's pose")),
              testing::ElementsAre("waiting for the robot's pose"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen) << "it may be refused yet";
  talk.For(0.6, Runs(kOrder, Status::APPROACHING, "approaching"));
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kAccepted, "approaching"));
  EXPECT_EQ(talk.orders, 1);
}

TEST(MissionOrder, IsAcceptedWhenThePlannerWaitsForTheRobotForThreeSeconds) {
  Talk talk;
  talk.For(0.6, Idle());
  talk.For(2.4, Runs(kOrder, Status::WAITING, "waiting"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  talk.For(1.2, Runs(kOrder, Status::WAITING, "waiting"));
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kAccepted, "waiting"));
}

TEST(MissionOrder, IsFollowedToItsEnd) {
  struct {
    int outcome;
    OrderOutcome expected;
  } const cases[] = {{mission_result_t::DONE, OrderOutcome::kDone},
                     {mission_result_t::FAILED, OrderOutcome::kFailed},
                     {mission_result_t::CANCELLED, OrderOutcome::kCancelled},
                     {mission_result_t::REFUSED, OrderOutcome::kRefused}};
  for (const auto& c : cases) {
    Talk talk(mission_command_t::PASS_DOOR, true);
    talk.For(0.6, Idle());
    talk.For(20, Runs(kOrder, Status::PASSING, "passing"));
    EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
    talk.For(0.6, Ended(kOrder, c.outcome, "so it ended"));
    EXPECT_THAT(talk.dut, Came(c.expected, "so it ended"));
  }
}

TEST(MissionOrder, TheEndOfAnotherOrderIsNotTheAnswer) {
  Talk talk(mission_command_t::PASS_DOOR, true);
  talk.For(0.6, Ended(3, mission_result_t::FAILED, "no way"));
  talk.For(2, Runs(9, Status::PASSING, "somebody else's"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  EXPECT_GE(talk.orders, 2) << "it was lost";
}

TEST(MissionOrder, BehindAnotherMissionItWaits) {
  Talk talk, follows(mission_command_t::GOTO, true);
  for (Talk* t : {&talk, &follows}) {
    t->For(0.6, Runs(3, Status::PASSING, "passing"));
    t->For(0.6, AndWaits(Runs(3, Status::PASSING, "passing"), kOrder));
  }
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kAccepted, "order 7 waits, 1 before it"));
  EXPECT_EQ(follows.dut.outcome(), OrderOutcome::kOpen);
  follows.For(1, Runs(kOrder, Status::DRIVING, "driving"));
  follows.For(1, Ended(kOrder, mission_result_t::DONE, "there"));
  EXPECT_THAT(follows.dut, Came(OrderOutcome::kDone, "there"));
}

TEST(MissionOrder, CollectsHowItsStepsEndedOnceEach) {
  Talk talk(mission_command_t::RUN, true);
  talk.For(0.6, Idle());
  Status status = Ended(kOrder, mission_result_t::DONE, "at the first place");
  status.results[0].step = 1;
  status.running = true;
  status.order_id = kOrder;
  status.step = 2;
  status.n_steps = 3;
  status.text = "driving";
  EXPECT_THAT(talk.For(2, status), testing::ElementsAre("step 2 of 3: driving"));
  ASSERT_EQ(talk.dut.steps().size(), 1u);
  EXPECT_EQ(talk.dut.steps()[0].text, "at the first place");
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
}

TEST(MissionOrder, WithoutANumberItGetsOneAndKeepsIt) {
  Talk talk(mission_command_t::GOTO, false, 0);
  talk.For(0.6, Idle());
  const int id = talk.dut.id();
  EXPECT_GE(id, 1);
  EXPECT_LE(id, 65535);
  talk.For(2, Idle());
  EXPECT_GE(talk.orders, 2);
  EXPECT_EQ(talk.dut.id(), id);
}

/// Two people order in the same millisecond: the time gave both the same number.
TEST(MissionOrder, OrdersOfTheSameTimeHaveDifferentNumbers) {
  std::set<int> numbers;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Talk talk(MissionOrder(Order(mission_command_t::GOTO), false, seed));
    talk.For(0.6, Idle());
    numbers.insert(talk.dut.id());
  }
  EXPECT_EQ(numbers.size(), 20u);
}

TEST(MissionOrder, ANumberThatThePlannerReportsIsNotDrawn) {
  Talk first(MissionOrder(Order(mission_command_t::GOTO), false, 5));
  first.For(0.6, Idle());
  Talk second(MissionOrder(Order(mission_command_t::GOTO), false, 5));
  second.For(0.6, Ended(first.dut.id(), mission_result_t::DONE, "there"));
  EXPECT_NE(second.dut.id(), first.dut.id());
  EXPECT_EQ(second.dut.outcome(), OrderOutcome::kOpen);
}

TEST(MissionOrder, ANumberThatIsAnotherOrdersIsExchanged) {
  mission_command_t order = Order(mission_command_t::GOTO);
  order.title = "goto (2.60, 2.40)";
  Talk talk(MissionOrder(order, true, 5));
  talk.For(0.6, Idle());
  const int taken = talk.dut.id();
  Status others = Runs(taken, Status::DRIVING, "driving");
  others.title = "goto (2.20, 2.40)";
  talk.For(0.6, others);
  EXPECT_NE(talk.dut.id(), taken);
  EXPECT_EQ(talk.orders, 2);
  talk.For(0.6, Ended(taken, mission_result_t::DONE, "at (2.20, 2.40)"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  Status own = Ended(talk.dut.id(), mission_result_t::DONE, "at (2.60, 2.40)");
  talk.For(0.6, own);
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kDone, "at (2.60, 2.40)"));
}

TEST(MissionOrder, IsRepeatedAndGivenUpWhenThePlannerDoesNotTakeIt) {
  Talk talk;
  talk.For(8, Idle());
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kNoAnswer, HasSubstr("no order yet")));
  EXPECT_GE(talk.orders, 3);
}

TEST(MissionOrder, WithoutAPlannerItIsNotGiven) {
  Talk talk;
  talk.Silence(3);
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kNoAnswer, "no planner is heard"));
  EXPECT_EQ(talk.orders, 0);
}

TEST(MissionOrder, APlannerThatFallsSilentIsTold) {
  Talk talk(mission_command_t::PASS_DOOR, true);
  talk.For(0.6, Idle());
  talk.For(1, Runs(kOrder, Status::APPROACHING, "approaching"));
  talk.Silence(3);
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kNoAnswer, "the planner fell silent"));
}

TEST(MissionOrder, APlannerThatWasRestartedNoLongerKnowsIt) {
  Talk talk(mission_command_t::PASS_DOOR, true);
  talk.For(0.6, Idle());
  talk.For(3, Runs(kOrder, Status::APPROACHING, "approaching"));
  talk.Silence(1.5);
  talk.For(1.5, Idle());
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen) << "one status may have been lost";
  talk.For(1.5, Idle());
  EXPECT_THAT(talk.dut,
              Came(OrderOutcome::kNoAnswer, HasSubstr("the planner no longer knows order 7: it was")));
}

TEST(MissionOrder, AnOrderThatIsMissingForAMomentIsFollowedOn) {
  Talk talk(mission_command_t::PASS_DOOR, true);
  talk.For(0.6, Idle());
  for (int i = 0; i < 3; ++i) {
    talk.For(1, Runs(kOrder, Status::APPROACHING, "approaching"));
    talk.For(1.5, Runs(9, Status::PASSING, "somebody else's"));
  }
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  talk.For(0.6, Ended(kOrder, mission_result_t::DONE, "through"));
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kDone, "through"));
}

TEST(MissionOrder, AnAbortIsDoneWhenNothingRunsOrWaits) {
  Talk talk(mission_command_t::ABORT, false, kOrder);
  talk.For(0.6, AndWaits(Runs(3, Status::PASSING, "passing"), 4));
  EXPECT_EQ(talk.orders, 1);
  talk.For(0.3, AndWaits(Idle(), 4));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  talk.Stands();
  talk.For(0.6, Ended(kOrder, mission_result_t::DONE, "aborted by the operator"));
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kDone, "aborted by the operator: the robot stands"));
}

TEST(MissionOrder, AnAbortIsGivenAlsoToAPlannerThatKnowsNoMission) {
  Talk talk(mission_command_t::ABORT, false, 0);
  talk.For(0.6, Idle());
  EXPECT_EQ(talk.orders, 1);
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen) << "it was not heard yet";
  ASSERT_NE(talk.dut.id(), 0);
  talk.Stands();
  talk.For(0.6, Ended(talk.dut.id(), mission_result_t::DONE, "the robot is told to stand"));
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kDone, "the robot is told to stand: the robot stands"));
}

TEST(MissionOrder, PauseAndResumeAreDoneWhenThePlannerSaysSo) {
  const Status runs = Runs(3, Status::PASSING, "passing");
  Status holds = runs;
  holds.paused = true;
  Talk pause(mission_command_t::PAUSE, false, 0), resume(mission_command_t::RESUME, false, 0);
  pause.For(0.6, runs);
  EXPECT_EQ(pause.dut.outcome(), OrderOutcome::kOpen);
  pause.For(0.6, holds);
  EXPECT_EQ(pause.dut.outcome(), OrderOutcome::kOpen) << "the planner says so, the robot not yet";
  pause.Stands();
  pause.For(0.6, holds);
  EXPECT_THAT(pause.dut, Came(OrderOutcome::kDone, HasSubstr("paused: the robot stands")));
  resume.For(0.6, holds);
  EXPECT_EQ(resume.dut.outcome(), OrderOutcome::kOpen);
  resume.For(0.6, runs);
  EXPECT_EQ(resume.dut.outcome(), OrderOutcome::kDone);
}

TEST(MissionOrder, InABlackoutAPauseOrAbortIsOrderedAndNotDone) {
  Status holds = Runs(3, Status::PASSING, "passing");
  Talk pause(mission_command_t::PAUSE, false, 0), abort(mission_command_t::ABORT, false, kOrder);
  for (Talk* talk : {&pause, &abort}) talk->For(0.6, holds);
  holds.paused = true;
  pause.For(5, holds);
  abort.For(5, Ended(kOrder, mission_result_t::DONE, "aborted by the operator"));
  for (Talk* talk : {&pause, &abort})
    EXPECT_THAT(talk->dut, Came(OrderOutcome::kOrdered, HasSubstr("nothing is heard from the robot for")));
}

TEST(MissionOrder, WhereThereIsNothingToPauseResumeOrCancelItIsRefused) {
  Talk pause(mission_command_t::PAUSE, false, 0), resume(mission_command_t::RESUME, false, 0);
  Talk cancel(mission_command_t::CANCEL, false, 9);
  for (Talk* talk : {&pause, &resume, &cancel}) talk->For(1, Idle());
  EXPECT_THAT(pause.dut, Came(OrderOutcome::kRefused, "no mission is under way"));
  EXPECT_THAT(resume.dut, Came(OrderOutcome::kRefused, "nothing is paused"));
  EXPECT_THAT(cancel.dut, Came(OrderOutcome::kRefused, "no order 9 is under way or waits"));
}

TEST(MissionOrder, ACancelIsDoneWhenItsOrderHasEnded) {
  Talk talk(mission_command_t::CANCEL, false, 9);
  talk.For(0.6, AndWaits(Runs(3, Status::PASSING, "passing"), 9));
  EXPECT_EQ(talk.orders, 1);
  talk.For(0.6, Ended(9, mission_result_t::CANCELLED, "cancelled by the operator"));
  EXPECT_THAT(talk.dut, Came(OrderOutcome::kDone, "cancelled by the operator"));
}

TEST(DoorNamed, KnowsNamesAndNumbersAndTheNearestName) {
  GroundPlan plan;
  plan.doors.resize(2);
  plan.doors[0].id = 4;
  plan.doors[0].name = "laboratory";
  plan.doors[1].id = 5;
  plan.doors[1].name = "office";
  EXPECT_EQ(DoorNamed(plan, "laboratory", "map.toml"), 4);
  EXPECT_EQ(DoorNamed(plan, "7", "map.toml"), 7) << "the planner says whether its map has it";
  try {
    DoorNamed(plan, "labratory", "map.toml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown door \"labratory\"; nearest: \"laboratory\"; map.toml has laboratory, office");
  }
  EXPECT_THROW(DoorNamed(plan, "0", "map.toml"), ConfigError);
}

}  // namespace
}  // namespace priamos::cli
