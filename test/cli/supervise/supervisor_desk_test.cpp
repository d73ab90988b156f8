#include "cli/supervise/supervisor_desk.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;
using Order = process_order_t;
using Report = process_report_t;

constexpr int kTaken = -1;  ///< answered later

class SupervisorDeskTest : public testing::Test {
 protected:
  SupervisorDesk::Hands Hands(bool simulated = true) {
    SupervisorDesk::Hands hands;
    hands.look = [this](const std::string& name) -> std::optional<ProcessReport> {
      if (name != robot_.name && name != "onboard-head") return std::nullopt;
      ProcessReport report = robot_;
      report.name = name;
      return report;
    };
    hands.restart = [this](const std::string& name) { restarted_.push_back(name); };
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
  static ProcessReport Robot() {
    ProcessReport report;
    report.name = "onboard-robot";
    report.state = ProcessState::kReady;
    report.starts = 3;
    report.reason = std::string(200, 'w');
    return report;
  }

  ProcessReport robot_ = Robot();
  std::vector<std::string> restarted_, worlds_;
  SupervisorDesk dut_{Hands()};
  Time now_ = FromUtime(1'000'000'000);
  int number_ = 0;
};

TEST_F(SupervisorDeskTest, ARestartIsAnsweredWhenTheProcessIsReadyAgain) {
  const Order order = Make(Order::RESTART, "onboard-robot");
  EXPECT_FALSE(dut_.Take(order, now_));
  EXPECT_THAT(dut_.Step(now_), IsEmpty()) << "ready, but not ended yet";
  robot_.starts = 4;
  robot_.state = ProcessState::kStarting;
  EXPECT_THAT(dut_.Step(now_ + seconds(1)), IsEmpty());
  robot_.state = ProcessState::kReady;
  const auto reports = dut_.Step(now_ + seconds(2));
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].outcome, Report::DONE);
  EXPECT_EQ(reports[0].utime, ToUtime(now_ + seconds(2)));
  EXPECT_EQ(reports[0].request_id, order.request_id);
  EXPECT_EQ(reports[0].name, "onboard-robot");
  EXPECT_EQ(reports[0].text.size(), SupervisorDesk::kMostText) << "why it had ended, as far as that fits";
  EXPECT_THAT(dut_.Step(now_ + seconds(3)), IsEmpty()) << "once";
}

TEST_F(SupervisorDeskTest, ARestartThatTakesLongIsAnsweredAllTheSame) {
  EXPECT_FALSE(dut_.Take(Make(Order::RESTART, "onboard-robot"), now_));
  robot_.state = ProcessState::kBackOff;
  robot_.starts = 4;
  EXPECT_THAT(dut_.Step(now_ + SupervisorDesk::kReadyWithin - seconds(1)), IsEmpty());
  const auto reports = dut_.Step(now_ + SupervisorDesk::kReadyWithin);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].outcome, Report::DONE);
}

TEST_F(SupervisorDeskTest, ARestartIsObeyedOnceHoweverOftenItIsSaid) {
  const Order order = Make(Order::RESTART, "onboard-robot");
  EXPECT_FALSE(dut_.Take(order, now_));
  EXPECT_FALSE(dut_.Take(order, now_ + seconds(1))) << "it is under way";
  robot_.starts = 4;
  EXPECT_EQ(dut_.Step(now_ + seconds(1)).size(), 1u);
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
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-robot"), kTaken);
  now_ += seconds(1);
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-robot"), Report::TOO_OFTEN);
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-head"), kTaken) << "another one is";
  now_ += seconds(2);
  EXPECT_EQ(Outcome(Order::RESTART, "onboard-robot"), kTaken);
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
