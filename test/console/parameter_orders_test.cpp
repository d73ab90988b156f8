#include "console/parameter_orders.hpp"

#include <gtest/gtest.h>

namespace priamos::console {
namespace {

using std::chrono::seconds;
using enum ParameterWish::Kind;

class ParameterOrdersTest : public testing::Test {
 protected:
  ParameterOrdersTest() { dut_.Know("robot", table_); }

  ParameterTable table_{std::vector<Parameter>{{"speed", "m/s", "", 0, 1, LiveChange::kOnlyLower},
                                               {"gap", "m", "", 0, 1, LiveChange::kInRange}}};
  ParameterOrders dut_;
  Time now_ = FromUtime(1'000'000'000);
};

TEST_F(ParameterOrdersTest, AWishBecomesAnOrderThatIsRepeatedUntilItIsAnswered) {
  ASSERT_TRUE(dut_.Wish({kSet, "robot", "gap", 0.25}));
  const auto order = dut_.Step(now_);
  ASSERT_TRUE(order);
  EXPECT_EQ(order->process, parameter_order_t::ROBOT);
  EXPECT_EQ(order->action, parameter_order_t::SET);
  EXPECT_EQ(order->key, 2);
  EXPECT_EQ(order->value, 0.25);
  EXPECT_EQ(order->table, table_.Fingerprint());
  EXPECT_FALSE(dut_.Step(now_));
  EXPECT_EQ(dut_.Step(now_ + seconds(1))->request_id, order->request_id);
  parameter_value_t answer{};
  answer.request_id = order->request_id;
  dut_.Answered(answer);
  EXPECT_FALSE(dut_.Step(now_ + seconds(2)));
}

TEST_F(ParameterOrdersTest, OneAtATimeAndTheNextWhenNobodyAnswers) {
  ASSERT_TRUE(dut_.Wish({kRead, "robot", "speed"}));
  ASSERT_TRUE(dut_.Wish({kSave, "robot", ""}));
  EXPECT_EQ(dut_.Step(now_)->action, parameter_order_t::READ);
  EXPECT_EQ(dut_.Step(now_ + seconds(5))->action, parameter_order_t::READ);
  EXPECT_EQ(dut_.Step(now_ + seconds(9))->action, parameter_order_t::SAVE);
}

TEST_F(ParameterOrdersTest, WhatIsNotKnownIsNotTaken) {
  EXPECT_FALSE(dut_.Wish({kRead, "head", ""}));
  EXPECT_FALSE(dut_.Wish({kSet, "robot", "drive.estop", 0}));
  dut_.Know("teleop", table_);
  EXPECT_FALSE(dut_.Wish({kRead, "teleop", ""})) << "it obeys no orders";
  EXPECT_FALSE(dut_.Step(now_));
}

TEST_F(ParameterOrdersTest, AFloodOfWishesIsBoundedAndTheNewestValueCounts) {
  for (int i = 0; i <= 1000; ++i) EXPECT_TRUE(dut_.Wish({kSet, "robot", "gap", i / 1000.0}));
  EXPECT_EQ(dut_.Step(now_)->value, 1);
  EXPECT_FALSE(dut_.Step(now_));
}

}  // namespace
}  // namespace priamos::console
