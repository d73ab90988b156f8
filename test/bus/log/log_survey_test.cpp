#include "bus/log/log_survey.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {
namespace {

class SurveyTest : public testing::Test {
 protected:
  void Add(std::int64_t number, std::int64_t utime, const std::string& channel,
           const std::vector<std::byte>& bytes) {
    AppendEvent(text_, number, utime, channel, bytes);
  }
  LogSurvey Dut() const {
    LogReader reader(std::as_bytes(std::span(text_)));
    return Survey(reader, schema_);
  }
  Schema schema_ = OwnTypes();
  std::vector<std::byte> pose_ = Encode(pose_t{});
  std::string text_;
};

TEST_F(SurveyTest, CountsPerChannel) {
  for (int i = 0; i < 11; ++i) Add(i, 1'000'000 + i * 100'000, "POSE", pose_);
  Add(11, 2'500'000, "OTHER", std::vector<std::byte>(20));
  const auto survey = Dut();
  EXPECT_EQ(survey.events, 12u);
  EXPECT_EQ(survey.first_utime, 1'000'000);
  EXPECT_EQ(survey.last_utime, 2'500'000);
  EXPECT_EQ(survey.channels.at("POSE").types, std::set<std::string>{"priamos.pose_t"});
  EXPECT_NEAR(survey.channels.at("POSE").RateHz(), 10, 1e-9);
  EXPECT_EQ(survey.channels.at("OTHER").types, std::set<std::string>{"?"});
  EXPECT_EQ(survey.undecodable, 1u);
  EXPECT_TRUE(survey.whole());
}

TEST_F(SurveyTest, MissingNumbersAreLosses) {
  for (const int number : {0, 1, 5, 6, 7}) Add(number, 1000 + number, "POSE", pose_);
  EXPECT_EQ(Dut().missing_numbers, 3u);
}

TEST_F(SurveyTest, OneDamagedNumberIsNoLoss) {
  for (const int number : {0, 1, 200, 3, 4, 5}) Add(number, 1000, "POSE", pose_);
  EXPECT_EQ(Dut().missing_numbers, 0u);
}

TEST_F(SurveyTest, WhatIsLeftBetweenTwoGapsIsNotMissing) {
  for (const int number : {0, 1, 5, 9, 10}) Add(number, 1000, "POSE", pose_);
  EXPECT_EQ(Dut().missing_numbers, 6u) << "2 to 4, and 6 to 8";
}

TEST_F(SurveyTest, SeveralEventsAloneBetweenGapsAreNotMissing) {
  for (const int number : {0, 3, 6, 9, 12}) Add(number, 1000, "POSE", pose_);
  EXPECT_EQ(Dut().missing_numbers, 8u);
}

TEST_F(SurveyTest, OneNumberDamagedToASmallerOneIsNoLoss) {
  for (const int number : {0, 1, 2, 1, 4, 5}) Add(number, 1000, "POSE", pose_);
  EXPECT_EQ(Dut().missing_numbers, 0u);
}

/// Whatever is taken out of a log, if some of it stays together.
RC_GTEST_FIXTURE_PROP(SurveyTest, CountsWhatWasTakenOut,
                      (const std::vector<std::pair<std::uint8_t, bool>>& gaps)) {
  std::uint64_t missing = 0;
  std::int64_t number = 0;
  Add(number++, 1000, "A", pose_);
  for (const auto& [gap, alone] : gaps) {
    missing += gap;
    number += gap;
    Add(number++, 1000, "A", pose_);
    if (!alone) Add(number++, 1000, "A", pose_);
  }
  Add(number++, 1000, "A", pose_);
  RC_ASSERT(Dut().missing_numbers == missing);
}

TEST_F(SurveyTest, AnyNumberIsTakenAndGapsBetweenLargeOnesAreLosses) {
  for (const std::int64_t number :
       {INT64_MAX - 5, INT64_MAX - 2, INT64_MAX - 1, INT64_MAX, INT64_MIN, INT64_MIN + 1})
    Add(number, 1000, "POSE", pose_);
  EXPECT_EQ(Dut().events, 6u);
  EXPECT_EQ(Dut().missing_numbers, 2u);
}

TEST_F(SurveyTest, JoinedLogsAreNoLoss) {
  for (const int number : {0, 1, 2, 0, 1, 2}) Add(number, 1000, "POSE", pose_);
  EXPECT_EQ(Dut().missing_numbers, 0u);
}

TEST_F(SurveyTest, DamageIsReported) {
  for (int i = 0; i < 3; ++i) Add(i, 1000, "POSE", pose_);
  text_[text_.size() / 2] = '\x01';
  text_.insert(text_.size() / 3 * 2, "garbage");
  const auto survey = Dut();
  EXPECT_FALSE(survey.whole());
  EXPECT_GT(survey.skipped_bytes, 6u);
}

TEST_F(SurveyTest, NothingIsInAnEmptyLog) {
  EXPECT_EQ(Dut().events, 0u);
}

}  // namespace
}  // namespace priamos::bus
