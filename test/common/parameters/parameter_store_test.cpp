#include "common/parameters/parameter_store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace priamos {
namespace {

struct Item {
  double width = 1;
  void Describe(Archive& a) { a.Number("width", width, {"m", 0, 9, "an item of a list"}); }
};

struct Inner {
  double speed = 0.6, margin = 0.02;
  void Describe(Archive& a) {
    a.Number("speed", speed, {"m/s", 0.05, 1.5, "fastest"});
    a.Number("margin", margin, {"m", 0, 0.5, "kept free"});
  }
};

/// A configuration with keys of every kind, three of which are live.
struct Settings {
  double rate = 50, low = 1, high = 2;
  int count = 3;
  std::vector<Item> items{{}, {}};
  Inner inner;
  void Describe(Archive& a) {
    a.Number("rate", rate, {"Hz", 1, 100, "of everything"});
    a.Integer("count", count, {"-", 0, 9, "whole"});
    a.List("items", items, "a list");
    a.Number("low", low, {"-", 0, 10, "lower bound"});
    a.Number("high", high, {"-", 0, 10, "upper bound"});
    a.Section("inner", inner, "a section");
    if (low > high) a.Refuse("low", "at most high");
    a.Live("inner.speed", LiveChange::kOnlyLower);
    a.Live("inner.margin", LiveChange::kOnlyHigher);
    a.Live("low", LiveChange::kInRange);
  }
};

constexpr int kSpeed = 1, kMargin = 2, kLow = 3;

class ParameterStoreTest : public testing::Test {
 protected:
  Settings settings_;
  ParameterStore store_{[this](Archive& a) { settings_.Describe(a); }};
};

TEST_F(ParameterStoreTest, TheTableHasTheMarkedNumbersInTheOrderOfTheMarks) {
  const ParameterTable& table = store_.table();
  ASSERT_EQ(table.all().size(), 3U);
  EXPECT_EQ(table.NumberOf("inner.speed"), kSpeed);
  EXPECT_EQ(table.NumberOf("low"), kLow);
  EXPECT_EQ(table.NumberOf("rate"), 0) << "it is not live";
  EXPECT_EQ(table.Find(kMargin)->unit, "m");
  EXPECT_EQ(table.Find(kMargin)->meaning, "kept free");
  EXPECT_EQ(table.Find(0), nullptr);
  EXPECT_EQ(table.Find(4), nullptr);
  EXPECT_EQ(table.Find(-1), nullptr);
}

TEST_F(ParameterStoreTest, AChangeIsInTheConfigurationAtOnceAndNothingElseIsTouched) {
  EXPECT_EQ(store_.Set(kSpeed, 0.3), ChangeVerdict::kDone);
  EXPECT_EQ(settings_.inner.speed, 0.3);
  EXPECT_EQ(store_.ValueOf(kSpeed), 0.3);
  EXPECT_EQ(store_.FileValueOf(kSpeed), 0.6);
  EXPECT_EQ(settings_.inner.margin, 0.02);
  EXPECT_EQ(settings_.rate, 50);
  EXPECT_EQ(settings_.items.at(1).width, 1);
}

TEST_F(ParameterStoreTest, WhatIsRefusedChangesNothing) {
  const auto refused = [&](int number, double value) {
    const ChangeVerdict verdict = store_.Set(number, value);
    EXPECT_EQ(store_.NextChanged(0), 0);
    return verdict;
  };
  EXPECT_EQ(refused(0, 1), ChangeVerdict::kUnknownKey);
  EXPECT_EQ(refused(99, 1), ChangeVerdict::kUnknownKey);
  EXPECT_EQ(refused(-5, 1), ChangeVerdict::kUnknownKey);
  EXPECT_EQ(refused(kSpeed, 0.04), ChangeVerdict::kOutOfRange);
  EXPECT_EQ(refused(kSpeed, 9), ChangeVerdict::kOutOfRange);
  EXPECT_EQ(refused(kSpeed, std::nan("")), ChangeVerdict::kOutOfRange);
  EXPECT_EQ(refused(kLow, std::numeric_limits<double>::infinity()), ChangeVerdict::kOutOfRange);
  EXPECT_EQ(refused(kSpeed, 0.7), ChangeVerdict::kLessCareful);
  EXPECT_EQ(refused(kMargin, 0.01), ChangeVerdict::kLessCareful);
  EXPECT_EQ(refused(kLow, 3), ChangeVerdict::kContradicts);
}

TEST_F(ParameterStoreTest, TheCarefulSideIsThatOfTheFileAlsoAfterAChange) {
  EXPECT_EQ(store_.Set(kSpeed, 0.2), ChangeVerdict::kDone);
  EXPECT_EQ(store_.Set(kSpeed, 0.6), ChangeVerdict::kDone);
  EXPECT_EQ(store_.Set(kSpeed, 0.61), ChangeVerdict::kLessCareful);
}

TEST_F(ParameterStoreTest, WhatDiffersFromTheFileIsFoundOneByOneAndUndone) {
  store_.Set(kLow, 2);
  store_.Set(kSpeed, 0.5);
  EXPECT_EQ(store_.NextChanged(0), kSpeed);
  EXPECT_EQ(store_.NextChanged(kSpeed), kLow);
  EXPECT_EQ(store_.NextChanged(kLow), 0);
  EXPECT_EQ(store_.Changed(),
            (std::vector<std::pair<std::string, double>>{{"inner.speed", 0.5}, {"low", 2}}));
  store_.Reset();
  EXPECT_EQ(store_.NextChanged(0), 0);
  EXPECT_EQ(settings_.inner.speed, 0.6);
}

/// A configuration of one key with one mark.
ParameterTable OneKey(const char* name, const ValueSpec& spec, LiveChange change, const char* mark) {
  return ParameterTable([=](Archive& a) {
    double value = 0;
    a.Number(name, value, spec);
    a.Live(mark, change);
  });
}

TEST(ParameterTableTest, TheFingerprintDiffersWithNameUnitRangeAndMark) {
  using enum LiveChange;
  const int first = OneKey("a", {"m", 0, 1, ""}, kInRange, "a").Fingerprint();
  EXPECT_EQ(OneKey("a", {"m", 0, 1, "other words"}, kInRange, "a").Fingerprint(), first);
  EXPECT_NE(OneKey("b", {"m", 0, 1, ""}, kInRange, "b").Fingerprint(), first);
  EXPECT_NE(OneKey("a", {"mm", 0, 1, ""}, kInRange, "a").Fingerprint(), first);
  EXPECT_NE(OneKey("a", {"m", 0, 2, ""}, kInRange, "a").Fingerprint(), first);
  EXPECT_NE(OneKey("a", {"m", 0, 1, ""}, kOnlyLower, "a").Fingerprint(), first);
  EXPECT_GE(first, 1);
  EXPECT_LE(first, 65535);
}

TEST(ParameterTableTest, AMarkOnNoNumberOrWithoutRoomInAnOrderIsAnErrorOfTheProgram) {
  using enum LiveChange;
  EXPECT_THROW(OneKey("a", {"m", 0, 1, ""}, kInRange, "b"), std::logic_error);
  EXPECT_THROW(OneKey("a", {"m", 0, 20000, ""}, kInRange, "a"), std::logic_error);
  EXPECT_THROW(OneKey("a", {.unit = "m", .doc = "any"}, kInRange, "a"), std::logic_error);
}

}  // namespace
}  // namespace priamos
