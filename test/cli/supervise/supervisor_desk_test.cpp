#include "cli/supervise/supervisor_desk.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;
using Order = process_order_t;
using Report = process_report_t;

class SupervisorDeskTest : public testing::Test {
 protected:
  SupervisorDesk::Hands Hands(bool simulated = true) {
    SupervisorDesk::Hands hands;
    hands.has = [](const std::string& name) { return name == "onboard-robot" || name == "onboard-head"; };
    hands.restart = [this](const std::string& name) {
      restarted_.push_back(name);
      return std::string(200, 'w');
    };
    hands.console = [](const std::string& name, std::int64_t end) -> std::optional<ConsolePiece> {
      if (name == "onboard-head") return std::nullopt;
      return ConsolePiece{end + 7, "lines"};
    };
    if (simulated)
      hands.new_world = [this](const std::string& scenario) {
        if (scenario != "door") return false;
        worlds_.push_back(scenario);
        return true;
      };
    return hands;
  }
  Order Make(std::int8_t action, const std::string& name) {
    Order order{};
    order.utime = ToUtime(now_);
    order.request_id = ++number_;
    order.action = action;
    order.name = name;
    return order;
  }
  int Outcome(std::int8_t action, const std::string& name) {
    const auto report = dut_.Take(Make(action, name), now_);
    return report ? report->outcome : -1;
  }

  std::vector<std::string> restarted_, worlds_;
  SupervisorDesk dut_{Hands()};
  Time now_ = FromUtime(1'000'000'000);
  int number_ = 0;
};

TEST_F(SupervisorDeskTest, ARestartIsObeyedOnceHoweverOftenItIsSaid) {
  const Order order = Make(Order::RESTART, "onboard-robot");
  const auto report = dut_.Take(order, now_);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outcome, Report::DONE);
  EXPECT_EQ(report->request_id, order.request_id);
  EXPECT_EQ(report->name, "onboard-robot");
  EXPECT_EQ(report->text.size(), SupervisorDesk::kMostText) << "why it had ended, as far as that fits";
  for (int s = 1; s < 9; ++s) EXPECT_EQ(dut_.Take(order, now_ + seconds(s))->outcome, Report::DONE);
  EXPECT_THAT(restarted_, ElementsAre("onboard-robot"));
}

TEST_F(SupervisorDeskTest, WhatIsOldOrOfTheFutureIsNotObeyed) {
  const Order order = Make(Order::RESTART, "onboard-robot");
  EXPECT_EQ(dut_.Take(order, now_ + seconds(11))->outcome, Report::TOO_OLD);
  now_ += seconds(60);
  const Order later = Make(Order::RESTART, "onboard-robot");
  EXPECT_EQ(dut_.Take(later, now_ - seconds(2))->outcome, Report::TOO_OLD);
  EXPECT_THAT(restarted_, IsEmpty());
}

TEST_F(SupervisorDeskTest, OneProcessIsNotRestartedAgainAtOnce) {
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-robot"), Report::DONE);
  now_ += seconds(1);
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-robot"), Report::TOO_OFTEN);
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-head"), Report::DONE) << "another one is";
  now_ += seconds(2);
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-robot"), Report::DONE);
  EXPECT_THAT(restarted_, ElementsAre("onboard-robot", "onboard-head", "onboard-robot"));
}

TEST_F(SupervisorDeskTest, OnlyOwnProcessesAreAnsweredFor) {
  for (const char* name : {"offboard-planner", "", "../../etc/passwd", "onboard-robot "})
    for (const auto action : {Order::RESTART, Order::LOG, std::int8_t{3}})
      EXPECT_EQ(Outcome(action, name), -1) << name;
  EXPECT_EQ(Outcome(3, "onboard-robot"), Report::UNKNOWN_ACTION);
  EXPECT_THAT(restarted_, IsEmpty());
}

TEST_F(SupervisorDeskTest, TellsLinesOfAConsole) {
  Order order = Make(Order::LOG, "onboard-robot");
  order.end_bytes = 100;
  const auto report = dut_.Take(order, now_);
  EXPECT_EQ(report->outcome, Report::DONE);
  EXPECT_EQ(report->text, "lines");
  EXPECT_EQ(report->begin_bytes, 107);
  EXPECT_EQ(Outcome(Order::LOG, "onboard-head"), Report::NO_CONSOLE);
}

TEST_F(SupervisorDeskTest, ANewWorldIsAmongThoseOnOffer) {
  EXPECT_EQ(Outcome(Order::NEW_WORLD, "moon"), Report::UNKNOWN_SCENARIO);
  now_ += seconds(4);
  EXPECT_EQ(Outcome(Order::NEW_WORLD, "door"), Report::DONE);
  EXPECT_EQ(Outcome(Order::NEW_WORLD, "door"), Report::TOO_OFTEN);
  EXPECT_THAT(worlds_, ElementsAre("door"));
  SupervisorDesk real(Hands(false));
  EXPECT_FALSE(real.Take(Make(Order::NEW_WORLD, "door"), now_)) << "a real robot has no other world";
}

TEST_F(SupervisorDeskTest, OfAFloodTheFirstAreAnswered) {
  int answered = 0;
  for (int i = 0; i < 1000; ++i) answered += Outcome(Order::LOG, "onboard-robot") >= 0 ? 1 : 0;
  EXPECT_EQ(answered, static_cast<int>(SupervisorDesk::kMostOrders));
  now_ += seconds(11);
  EXPECT_EQ(Outcome(Order::LOG, "onboard-robot"), Report::DONE);
}

}  // namespace
}  // namespace priamos::cli
