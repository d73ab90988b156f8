#include "console/process_orders.hpp"

#include <gtest/gtest.h>

namespace priamos::console {
namespace {

using std::chrono::seconds;
using enum ProcessWish::Kind;

class ProcessOrdersTest : public testing::Test {
 protected:
  ProcessOrdersTest() {
    process_state_t state{};
    state.process = "onboard-robot";
    dut_.Know(state);
    simulation_t simulation{};
    simulation.scenarios.resize(1);
    simulation.scenarios[0].name = "door";
    dut_.Know(simulation);
  }

  ProcessOrders dut_;
  Time now_ = FromUtime(1'000'000'000);
};

TEST_F(ProcessOrdersTest, AWishBecomesAnOrderThatIsRepeatedUntilItIsAnswered) {
  ASSERT_TRUE(dut_.Wish({kLog, "onboard-robot", 300}));
  const auto order = dut_.Step(now_);
  ASSERT_TRUE(order);
  EXPECT_EQ(order->action, process_order_t::LOG);
  EXPECT_EQ(order->name, "onboard-robot");
  EXPECT_EQ(order->end_bytes, 300);
  EXPECT_FALSE(dut_.Step(now_));
  EXPECT_EQ(dut_.Step(now_ + seconds(1))->request_id, order->request_id);
  process_report_t report{};
  report.request_id = order->request_id;
  dut_.Answered(report);
  EXPECT_FALSE(dut_.Step(now_ + seconds(2)));
}

TEST_F(ProcessOrdersTest, OneAtATimeAndTheNextWhenNobodyAnswers) {
  ASSERT_TRUE(dut_.Wish({kRestart, "onboard-robot"}));
  ASSERT_TRUE(dut_.Wish({kNewWorld, "door"}));
  EXPECT_EQ(dut_.Step(now_)->action, process_order_t::RESTART);
  EXPECT_EQ(dut_.Step(now_ + seconds(5))->action, process_order_t::RESTART);
  EXPECT_EQ(dut_.Step(now_ + seconds(9))->action, process_order_t::NEW_WORLD);
}

TEST_F(ProcessOrdersTest, WhatIsNotKnownIsNotTaken) {
  EXPECT_FALSE(dut_.Wish({kRestart, "onboard-head"}));
  EXPECT_FALSE(dut_.Wish({kRestart, "door"})) << "a scenario is no process";
  EXPECT_FALSE(dut_.Wish({kNewWorld, "onboard-robot"}));
  dut_.Know(simulation_t{});
  EXPECT_FALSE(dut_.Wish({kNewWorld, "door"})) << "it is not on offer any more";
  EXPECT_FALSE(dut_.Step(now_));
}

TEST_F(ProcessOrdersTest, AFloodOfWishesIsBounded) {
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(dut_.Wish({kLog, "onboard-robot", i}));
  EXPECT_EQ(dut_.Step(now_)->end_bytes, 999);
  EXPECT_FALSE(dut_.Step(now_));
  process_state_t state{};
  for (int i = 0; i < 1000; ++i) {
    state.process = std::to_string(i);
    dut_.Know(state);
  }
  EXPECT_FALSE(dut_.Wish({kLog, "999", 0})) << "who sends names without end is not believed";
}

}  // namespace
}  // namespace priamos::console
