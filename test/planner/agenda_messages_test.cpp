#include "planner/agenda_messages.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace priamos::planner {
namespace {

const Time kNow = FromUtime(1'234'567'000);

/// A mission that fails with the longest words.
class Talkative : public Mission {
 public:
  std::optional<Refusal> Start(const MissionOrder&) override { return std::nullopt; }
  void Step(MissionControl& control) override { control.Fail(std::string(300, 'a')); }
  const MissionLimits& limits() const override { return limits_; }
  std::string Unfinished() const override { return ""; }

 private:
  MissionLimits limits_;
};

/// The queue before one mission, number 9.
struct Queue {
  Queue() { missions.Add(9, std::make_unique<Talkative>()); }
  MissionTable missions;
  DoorRouter router{{}, {}, {}, {}, {}};
  Agenda agenda{missions, router, {2, 1}, {}, {}};
};

TEST(AgendaMessages, AStatusTellsTheOrderWhatWaitsAndHowTheLastOnesEnded) {
  Queue queue;
  AgendaOrder order{7, std::string(80, 't'), {{{9, 0, {}}, {}}, {{}, 5.0}}, 3};
  queue.agenda.Take(order, kNow);
  queue.agenda.Take({8, "next", {{{}, 4.0}}, 1}, kNow);
  mission_status_t message = StatusOf(queue.agenda, kNow);
  EXPECT_EQ(message.order_id, 7);
  EXPECT_EQ(message.title.size(), 60u);
  EXPECT_TRUE(message.running);
  EXPECT_EQ(message.step, 1);
  EXPECT_EQ(message.n_steps, 2);
  EXPECT_EQ(message.rounds, 3);
  EXPECT_EQ(message.left_s, -1) << "of mission 9 nobody knows how long it takes";
  ASSERT_EQ(message.n_waiting, 1);
  EXPECT_EQ(message.waiting[0].order_id, 8);
  EXPECT_EQ(message.waiting[0].title, "next");
  queue.agenda.Tick(kNow);
  message = StatusOf(queue.agenda, kNow);
  EXPECT_EQ(message.mission, 9);
  EXPECT_EQ(message.phase, mission_status_t::FAILED);
  EXPECT_EQ(message.text.size(), 200u);
  EXPECT_FALSE(message.running);
  ASSERT_EQ(message.n_results, 3) << "the step, the order, and the one that waited";
  EXPECT_EQ(message.results[0].step, 1);
  EXPECT_EQ(message.results[1].outcome, mission_result_t::FAILED);
  EXPECT_EQ(message.results[2].outcome, mission_result_t::CANCELLED);
}

TEST(AgendaMessages, AnOrderOfOneMissionHasOneStep) {
  mission_command_t message{};
  message.mission = mission_command_t::GOTO;
  message.order_id = 12;
  message.x_m = 3;
  message.turn = true;
  message.rounds = 5;
  const AgendaOrder order = OrderIn(message);
  EXPECT_EQ(order.id, 12);
  EXPECT_EQ(order.rounds, 1) << "only of RUN";
  ASSERT_EQ(order.steps.size(), 1u);
  EXPECT_EQ(order.steps[0].order.kind, mission_command_t::GOTO);
  EXPECT_EQ(order.steps[0].order.goal.map_from_base.x, 3);
  EXPECT_TRUE(order.steps[0].order.goal.turn);
}

TEST(AgendaMessages, AnOrderOfSeveralStepsHasThemInTurn) {
  mission_command_t message{};
  message.mission = mission_command_t::RUN;
  message.title = "round";
  message.rounds = 0;
  message.steps.resize(2);
  message.steps[0].mission = mission_command_t::PASS_DOOR;
  message.steps[0].landmark_id = 4;
  message.steps[0].wait_s = 9;
  message.steps[1].mission = mission_command_t::WAIT;
  message.steps[1].wait_s = 5;
  const AgendaOrder order = OrderIn(message);
  EXPECT_EQ(order.title, "round");
  EXPECT_EQ(order.rounds, 0);
  ASSERT_EQ(order.steps.size(), 2u);
  EXPECT_EQ(order.steps[0].order.landmark_id, 4);
  EXPECT_FALSE(order.steps[0].wait_s);
  EXPECT_EQ(order.steps[1].wait_s, 5);
}

}  // namespace
}  // namespace priamos::planner
