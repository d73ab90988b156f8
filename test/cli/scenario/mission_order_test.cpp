#include "cli/scenario/mission_order.hpp"

#include <gmock/gmock.h>

#include "cli/scenario/door_name.hpp"
#include "common/archive.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using Status = mission_status_t;

mission_command_t Order(int mission) {
  mission_command_t order{};
  order.mission = static_cast<std::int8_t>(mission);
  order.landmark_id = 1;
  return order;
}

Status Says(int phase, const std::string& text) {
  Status status{};
  status.phase = static_cast<std::int8_t>(phase);
  status.text = text;
  return status;
}

/// A planner that speaks twice a second, and somebody who gives it an order.
struct Talk {
  explicit Talk(int mission = mission_command_t::PASS_DOOR, bool to_the_end = false)
      : dut(Order(mission), to_the_end) {}

  /// The planner says this for so long. Returns what a person was told.
  std::vector<std::string> For(double seconds, const Status& status) {
    std::vector<std::string> told;
    for (const Time until = now + FromSeconds(seconds); now < until; now += FromSeconds(0.05), ++steps) {
      if (steps % 10 == 0)
        if (const auto text = dut.Hear(status, now)) told.push_back(*text);
      if (dut.Step(now)) ++orders;
    }
    return told;
  }
  void Silence(double seconds) {
    for (const Time until = now + FromSeconds(seconds); now < until; now += FromSeconds(0.05))
      if (dut.Step(now)) ++orders;
  }

  MissionOrder dut;
  Time now = FromUtime(5'000'000);
  int steps = 0, orders = 0;
};

/// An order with this outcome, the last words of which are `text`.
auto Ended(OrderOutcome outcome, const testing::Matcher<std::string>& text) {
  return testing::AllOf(testing::Property("outcome", &MissionOrder::outcome, outcome),
                        testing::Property("text", &MissionOrder::text, text));
}

const Status kIdle = Says(Status::WAITING, "no order yet");

TEST(MissionOrder, IsAcceptedWhenTheRobotIsUnderWay) {
  Talk talk;
  talk.For(0.6, kIdle);
  EXPECT_EQ(talk.orders, 1);
  EXPECT_THAT(talk.For(0.6, Says(Status::WAITING, "waiting for the robot's pose")),
              testing::ElementsAre("waiting for the robot's pose"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen) << "it may be refused yet";
  talk.For(0.6, Says(Status::APPROACHING, "approaching"));
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kAccepted, "approaching"));
  EXPECT_EQ(talk.orders, 1);
}

TEST(MissionOrder, IsAcceptedWhenThePlannerWaitsForTheRobotForThreeSeconds) {
  Talk talk;
  talk.For(0.6, kIdle);
  talk.For(2.4, Says(Status::WAITING, "waiting for the robot's pose"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  talk.For(1.2, Says(Status::WAITING, "waiting for the robot's pose"));
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kAccepted, "waiting for the robot's pose"));
}

TEST(MissionOrder, IsFollowedToItsEnd) {
  Talk done(mission_command_t::PASS_DOOR, true), failed(mission_command_t::PASS_DOOR, true);
  for (Talk* talk : {&done, &failed}) {
    talk->For(0.6, kIdle);
    talk->For(20, Says(Status::PASSING, "passing"));
    EXPECT_EQ(talk->dut.outcome(), OrderOutcome::kOpen);
  }
  done.For(0.6, Says(Status::DONE, "through the door"));
  EXPECT_EQ(done.dut.outcome(), OrderOutcome::kDone);
  failed.For(0.6, Says(Status::FAILED, "blocked"));
  EXPECT_THAT(failed.dut, Ended(OrderOutcome::kFailed, "blocked"));
}

TEST(MissionOrder, AFailureOfYesterdayIsNotTheAnswerButItsRepetitionIs) {
  Talk talk;
  talk.For(1, Says(Status::FAILED, "the map has no door 9"));
  EXPECT_EQ(talk.dut.outcome(), OrderOutcome::kOpen);
  talk.For(1.5, Says(Status::FAILED, "the map has no door 9"));
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kFailed, "the map has no door 9"));
}

TEST(MissionOrder, IsNotGivenWhileAnotherMissionIsUnderWay) {
  Talk talk;
  talk.For(0.6, Says(Status::PASSING, "passing"));
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kRefused, HasSubstr("passing")));
  EXPECT_EQ(talk.orders, 0);
}

TEST(MissionOrder, IsRepeatedAndGivenUpWhenThePlannerDoesNotTakeIt) {
  Talk talk;
  talk.For(8, kIdle);
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kNoAnswer, HasSubstr("no order yet")));
  EXPECT_GE(talk.orders, 3);
}

TEST(MissionOrder, WithoutAPlannerItIsNotGiven) {
  Talk talk;
  talk.Silence(3);
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kNoAnswer, "no planner is heard"));
  EXPECT_EQ(talk.orders, 0);
}

TEST(MissionOrder, APlannerThatFallsSilentIsTold) {
  Talk talk(mission_command_t::PASS_DOOR, true);
  talk.For(0.6, kIdle);
  talk.For(1, Says(Status::APPROACHING, "approaching"));
  talk.Silence(3);
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kNoAnswer, "the planner fell silent"));
}

TEST(MissionOrder, AnAbortIsDoneWhenTheMissionHasFailed) {
  Talk talk(mission_command_t::ABORT);
  talk.For(0.6, Says(Status::PASSING, "passing"));
  EXPECT_EQ(talk.orders, 1);
  talk.For(0.6, Says(Status::FAILED, "aborted by the operator"));
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kDone, "aborted by the operator"));
}

TEST(MissionOrder, AnAbortOfNothingIsToldSo) {
  Talk talk(mission_command_t::ABORT);
  talk.For(2, Says(Status::DONE, "through the door"));
  EXPECT_THAT(talk.dut, Ended(OrderOutcome::kDone, "no mission is under way"));
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
