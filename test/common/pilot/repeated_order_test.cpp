#include "common/pilot/repeated_order.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace priamos {
namespace {

struct Order {
  int request_id = 0;
};

/// Times in seconds at which an order with number 7 is sent within 20 s; answered at `answered_s`.
std::vector<double> TimesSent(double answered_s) {
  RepeatedOrder<Order> dut;
  const Time start{std::chrono::seconds(100)};
  dut.Give({7}, start);
  std::vector<double> times;
  for (int i = 0; i < 200; ++i) {
    const double t = i / 10.0;
    if (t >= answered_s) dut.Answered(7);
    if (const auto order = dut.Step(start + FromSeconds(t))) times.push_back(t);
  }
  return times;
}

TEST(RepeatedOrderTest, ItIsSentEverySecondUntilItIsAnswered) {
  EXPECT_EQ(TimesSent(2.5), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(TimesSent(0.05), (std::vector<double>{0}));
}

TEST(RepeatedOrderTest, WithoutAnAnswerItEndsAfterEightSeconds) {
  EXPECT_EQ(TimesSent(100), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(RepeatedOrderTest, AnAnswerToAnotherOrderIsNone) {
  RepeatedOrder<Order> dut;
  EXPECT_FALSE(dut.Answered(7)) << "none was given";
  dut.Give({7}, {});
  EXPECT_FALSE(dut.Answered(6));
  EXPECT_TRUE(dut.open());
}

}  // namespace
}  // namespace priamos
