#include "bus/parameters/parameter_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "bus/parameters/parameter_messages.hpp"

namespace priamos::bus {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;
using Value = parameter_value_t;

struct Settings {
  double speed = 0.6, gap = 0.1;
  void Describe(Archive& a) {
    a.Number("speed", speed, {"m/s", 0, 1.5, "fastest"});
    a.Number("gap", gap, {"m", 0, 1, "distance"});
    a.Live("speed", LiveChange::kOnlyLower);
    a.Live("gap", LiveChange::kInRange);
  }
};

constexpr int kSpeed = 1, kGap = 2;

class ParameterDeskTest : public testing::Test {
 protected:
  ~ParameterDeskTest() override { std::filesystem::remove(path_); }

  /// The desk's answer to an order that is given now.
  parameter_value_t Say(std::int8_t action, int key = 0, double value = 0) {
    now_ += std::chrono::milliseconds(5);
    const auto answer = desk_.Take(Order(action, key, value), now_);
    EXPECT_TRUE(answer);
    return answer.value_or(Value{});
  }
  parameter_order_t Order(std::int8_t action, int key = 0, double value = 0) const {
    return ToMessage({parameter_order_t::ROBOT, action, key, value}, store_.table(), now_);
  }

  std::string path_ = testing::TempDir() + "/desk" + std::to_string(getpid()) + ".toml";
  Settings settings_;
  int changes_ = 0;
  std::string said_;
  ParameterStore store_{[this](Archive& a) { settings_.Describe(a); }};
  ParameterDesk desk_{parameter_order_t::ROBOT,
                      store_,
                      {path_, [this] { ++changes_; }, [this](bool, std::string_view text) { said_ = text; }}};
  Time now_ = FromUtime(1'000'000'000);
};

TEST_F(ParameterDeskTest, SetsAndTellsWhatIsInForce) {
  const Value answer = Say(parameter_order_t::SET, kSpeed, 0.35);
  EXPECT_EQ(answer.outcome, Value::DONE);
  EXPECT_EQ(answer.value, 0.35);
  EXPECT_EQ(answer.key, kSpeed);
  EXPECT_TRUE(answer.unsaved);
  EXPECT_EQ(settings_.speed, 0.35);
  EXPECT_EQ(changes_, 1);
  EXPECT_EQ(said_, "speed: 0.6 -> 0.35 m/s");
  EXPECT_EQ(Say(parameter_order_t::READ, kSpeed).value, 0.35);
}

TEST_F(ParameterDeskTest, ARefusalSaysWhyAndWhatIsStillInForce) {
  const auto refused = [&](int key, double value) {
    const Value answer = Say(parameter_order_t::SET, key, value);
    EXPECT_EQ(answer.value, key == kSpeed ? 0.6 : 0.0);
    return answer.outcome;
  };
  EXPECT_EQ(refused(kSpeed, 0.7), Value::LESS_CAREFUL);
  EXPECT_EQ(refused(kSpeed, -1), Value::OUT_OF_RANGE);
  EXPECT_EQ(refused(kSpeed, std::nan("")), Value::OUT_OF_RANGE);
  EXPECT_EQ(refused(77, 1), Value::UNKNOWN_KEY);
  EXPECT_EQ(Say(parameter_order_t::READ, 77).outcome, Value::UNKNOWN_KEY);
  EXPECT_EQ(Say(9).outcome, Value::UNKNOWN_ACTION);
  EXPECT_EQ(desk_.refused(), 6U);
  EXPECT_EQ(changes_, 0);
}

TEST_F(ParameterDeskTest, AnotherTablesNumbersAreNotTaken) {
  parameter_order_t order = Order(parameter_order_t::SET, kSpeed, 0.3);
  order.table ^= 1;
  const auto answer = desk_.Take(order, now_);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->outcome, Value::OTHER_TABLE);
  EXPECT_EQ(answer->table, store_.table().Fingerprint());
  EXPECT_EQ(answer->key, 0);
  EXPECT_EQ(settings_.speed, 0.6);
}

TEST_F(ParameterDeskTest, ARepetitionIsAnsweredAndNotObeyedAgain) {
  const parameter_order_t first = Order(parameter_order_t::SET, kSpeed, 0.3);
  EXPECT_EQ(desk_.Take(first, now_)->outcome, Value::DONE);
  Say(parameter_order_t::SET, kSpeed, 0.4);
  const auto again = desk_.Take(first, now_ + seconds(5));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->outcome, Value::DONE);
  EXPECT_EQ(settings_.speed, 0.4) << "the newer order stays in force";
  EXPECT_EQ(desk_.Take(first, now_ + seconds(30))->outcome, Value::TOO_OLD);
  EXPECT_EQ(settings_.speed, 0.4);
}

TEST_F(ParameterDeskTest, OrdersOfThePastAndOfTheFutureAreRefused) {
  const parameter_order_t order = Order(parameter_order_t::SET, kSpeed, 0.3);
  EXPECT_EQ(desk_.Take(order, now_ + seconds(11))->outcome, Value::TOO_OLD);
  parameter_order_t early = order;
  early.request_id += 1;
  EXPECT_EQ(desk_.Take(early, now_ - seconds(2))->outcome, Value::TOO_OLD);
  EXPECT_EQ(settings_.speed, 0.6);
}

TEST_F(ParameterDeskTest, OrdersForAnotherProcessAreNotHeard) {
  parameter_order_t order = Order(parameter_order_t::SET, kSpeed, 0.3);
  order.process = parameter_order_t::HEAD;
  EXPECT_FALSE(desk_.Take(order, now_));
  EXPECT_EQ(desk_.refused(), 0U);
}

TEST_F(ParameterDeskTest, OfAFloodAHundredInTenSecondsAreObeyedAndTheRestCounted) {
  int answered = 0;
  for (int i = 0; i < 5000; ++i) {
    parameter_order_t order = Order(parameter_order_t::SET, kGap, 0.001 * (i % 900));
    order.request_id = i;
    answered += desk_.Take(order, now_) ? 1 : 0;
  }
  EXPECT_EQ(answered, 100);
  EXPECT_EQ(desk_.refused(), 4900U);
  now_ += seconds(11);
  EXPECT_EQ(Say(parameter_order_t::SET, kGap, 0.5).outcome, Value::DONE) << "afterwards it obeys again";
}

TEST_F(ParameterDeskTest, WhatDiffersIsFoundFromAnswerToAnswer) {
  Say(parameter_order_t::SET, kGap, 0.2);
  const Value none = Say(parameter_order_t::READ);
  EXPECT_EQ(none.outcome, Value::DONE);
  EXPECT_EQ(none.key, 0);
  EXPECT_EQ(none.next_changed, kGap);
  const Value gap = Say(parameter_order_t::READ, kGap);
  EXPECT_EQ(gap.value, 0.2);
  EXPECT_EQ(gap.next_changed, 0);
}

TEST_F(ParameterDeskTest, SavesAndResets) {
  Say(parameter_order_t::SET, kSpeed, 0.3);
  EXPECT_FALSE(Say(parameter_order_t::SAVE).unsaved);
  EXPECT_TRUE(std::filesystem::exists(path_));
  const Value reset = Say(parameter_order_t::RESET, kSpeed);
  EXPECT_EQ(reset.outcome, Value::DONE);
  EXPECT_EQ(reset.value, 0.6);
  EXPECT_FALSE(reset.unsaved);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST(ParameterDeskWithoutFileTest, SaysThatItCannotSave) {
  Settings settings;
  ParameterStore store([&](Archive& a) { settings.Describe(a); });
  std::string said;
  ParameterDesk desk(parameter_order_t::ROBOT, store,
                     {"", [] {}, [&](bool, std::string_view text) { said = text; }});
  const Time now = FromUtime(1'000'000'000);
  const auto order = ToMessage({parameter_order_t::ROBOT, parameter_order_t::SAVE, 0, 0}, store.table(), now);
  EXPECT_EQ(desk.Take(order, now)->outcome, Value::NOT_SAVED);
  EXPECT_THAT(said, HasSubstr("--saved"));
}

TEST(ParameterMessagesTest, TheRadioKeepsEveryValueOfSixDecimals) {
  for (const double value : {0.35, 0.1, -1.234567, 9999.999999, 0.0}) {
    const double sent = std::round(value / 1e-6) * 1e-6;  // as the radio unpacks it
    EXPECT_EQ(RoundedParameter(sent), value);
  }
}

TEST(ParameterMessagesTest, EveryOutcomeHasItsSentence) {
  for (int outcome = Value::DONE; outcome <= Value::UNKNOWN_ACTION; ++outcome)
    EXPECT_NE(OutcomeText(outcome), OutcomeText(99)) << outcome;
  EXPECT_EQ(ProcessOfParameters(*ParameterProcess("head")), "head");
  EXPECT_EQ(ProcessOfParameters(7), "");
  EXPECT_FALSE(ParameterProcess("teleop"));
}

}  // namespace
}  // namespace priamos::bus
