#include "console/foxglove/parameter_board.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace priamos::console {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr ParameterBoard::Client kAnna = 1, kBert = 2;

struct Sent {
  ParameterBoard::Client client;
  std::string values;  ///< name=value, with blanks between
  std::string id;
};

class ParameterBoardTest : public testing::Test {
 protected:
  ParameterBoardTest()
      : dut_({[this](ParameterBoard::Client client, std::span<const ShownParameter> values,
                     std::string_view id) {
                std::string text;
                for (const auto& [name, value] : values)
                  text += (text.empty() ? "" : " ") + name + "=" + json(value).dump();
                sent_.push_back({client, text, std::string(id)});
              },
              [this](ParameterBoard::Client, const std::string& sentence) { warnings_.push_back(sentence); },
              [this](ParameterBoard::Client client, const std::string& message) {
                orders_.push_back(message);
                return client == kAnna ? std::nullopt
                                       : std::optional(Refusal{"expected somebody who may drive"});
              }}) {}

  void Know() {
    dut_.Know("robot", std::vector<ShownParameter>{{"drive.speed", 0.5}, {"drive.turn", 1}});
    dut_.Know("head", std::vector<ShownParameter>{{"look.age", 2}});
  }

  std::vector<Sent> sent_;
  std::vector<std::string> warnings_, orders_;
  ParameterBoard dut_;
};

TEST_F(ParameterBoardTest, ShowsTheValuesOfTheFilesUntilAProcessHasAnswered) {
  Know();
  dut_.Take(kAnna, GetParametersRequest{{}, "7"});
  ASSERT_THAT(sent_, SizeIs(1));
  EXPECT_EQ(sent_[0].values, "head/look.age=2.0 robot/drive.speed=0.5 robot/drive.turn=1.0");
  EXPECT_EQ(sent_[0].id, "7");
  dut_.Heard("robot", 2, 0.25, 0, "");
  dut_.Take(kAnna, GetParametersRequest{{"robot/drive.turn", "nobody/knows"}, "8"});
  EXPECT_EQ(sent_.back().values, "robot/drive.turn=0.25");
}

TEST_F(ParameterBoardTest, WhoAsksHasEveryProcessAskedAndThenEveryKeyThatDiffersFromItsFileOnce) {
  Know();
  dut_.Take(kAnna, GetParametersRequest{});
  EXPECT_THAT(orders_, ElementsAre(R"({"type":"parameter","action":"read","process":"head"})",
                                   R"({"type":"parameter","action":"read","process":"robot"})"));
  orders_.clear();
  dut_.Heard("robot", 0, 0, 2, "");
  EXPECT_THAT(orders_,
              ElementsAre(R"({"type":"parameter","action":"read","process":"robot","key":"drive.turn"})"));
  dut_.Heard("robot", 0, 0, 2, "");
  dut_.Heard("robot", 2, 0.25, 0, "");
  EXPECT_THAT(orders_, SizeIs(1));
}

TEST_F(ParameterBoardTest, WhoComesBeforeTheProcessesAreKnownIsAnsweredWhenTheyAre) {
  dut_.Take(kAnna, GetParametersRequest{{}, "7"});
  dut_.Step(FromUtime(0));
  EXPECT_THAT(sent_, IsEmpty());
  Know();
  dut_.Step(FromUtime(0));
  ASSERT_THAT(sent_, SizeIs(1));
  EXPECT_THAT(sent_[0].values, HasSubstr("drive.speed=0.5"));
}

TEST_F(ParameterBoardTest, AChangeIsAnsweredWithWhatTheProcessSaysOfIt) {
  Know();
  dut_.Take(kAnna, SetParametersRequest{{{"robot/drive.speed", 0.3}, {"head/look.age", 1}}, "9"});
  EXPECT_THAT(
      orders_,
      ElementsAre(R"({"type":"parameter","action":"set","process":"robot","key":"drive.speed","value":0.3})",
                  R"({"type":"parameter","action":"set","process":"head","key":"look.age","value":1.0})"));
  dut_.Heard("robot", 1, 0.3, 1, "");
  EXPECT_THAT(sent_, IsEmpty());
  dut_.Heard("head", 1, 2, 0, "out of range");
  ASSERT_THAT(sent_, SizeIs(1));
  EXPECT_EQ(sent_[0].values, "head/look.age=2.0 robot/drive.speed=0.3");
  EXPECT_EQ(sent_[0].id, "9");
  EXPECT_THAT(warnings_, ElementsAre("head/look.age: out of range"));
}

TEST_F(ParameterBoardTest, WhatCannotBeOrderedIsAnsweredAtOnceWithTheReason) {
  Know();
  dut_.Take(kBert, SetParametersRequest{{{"robot/drive.speed", 0.3}}, "1"});
  dut_.Take(kAnna, SetParametersRequest{{{"robot/drive.speed", std::nullopt}}, "2"});
  dut_.Take(kAnna, SetParametersRequest{{{"drive", 3}}, "3"});
  EXPECT_THAT(warnings_,
              ElementsAre("robot/drive.speed: expected somebody who may drive",
                          "robot/drive.speed: expected a number", "drive: there is no such parameter"));
  ASSERT_THAT(sent_, SizeIs(3));
  EXPECT_EQ(sent_[0].values, "robot/drive.speed=0.5");
  EXPECT_EQ(sent_[2].values, "");
}

TEST_F(ParameterBoardTest, SilenceEndsTheWait) {
  Know();
  dut_.Step(FromUtime(0));
  dut_.Take(kAnna, SetParametersRequest{{{"robot/drive.speed", 0.3}}, "9"});
  dut_.Step(FromUtime(29'000'000));
  EXPECT_THAT(sent_, IsEmpty());
  dut_.Step(FromUtime(31'000'000));
  ASSERT_THAT(sent_, SizeIs(1));
  EXPECT_EQ(sent_[0].values, "robot/drive.speed=0.5");
  EXPECT_THAT(warnings_, ElementsAre("robot/drive.speed: the robot has not answered"));
  dut_.Step(FromUtime(90'000'000));
  EXPECT_THAT(sent_, SizeIs(1));
}

TEST_F(ParameterBoardTest, AChangeWithoutANumberIsNotAnswered) {
  Know();
  dut_.Take(kAnna, SetParametersRequest{{{"robot/drive.speed", 0.3}}, ""});
  dut_.Heard("robot", 1, 0.3, 1, "");
  EXPECT_THAT(sent_, IsEmpty());
}

TEST_F(ParameterBoardTest, WatchersHearOfWhatTheyWatchUntilTheyDoNotOrLeave) {
  Know();
  dut_.Take(kAnna, WatchParametersRequest{{"robot/drive.turn"}, true});
  dut_.Take(kBert, WatchParametersRequest{{}, true});
  dut_.Heard("robot", 1, 0.4, 0, "");
  ASSERT_THAT(sent_, SizeIs(1));
  EXPECT_EQ(sent_[0].client, kBert);
  dut_.Heard("robot", 2, 0.9, 0, "");
  EXPECT_THAT(sent_, SizeIs(3));
  dut_.Take(kAnna, WatchParametersRequest{{"robot/drive.turn"}, false});
  dut_.Leave(kBert);
  dut_.Heard("robot", 2, 0.8, 0, "");
  EXPECT_THAT(sent_, SizeIs(3));
}

TEST_F(ParameterBoardTest, AnswersOfStrangeProcessesAndNumbersAreNoParameters) {
  Know();
  dut_.Heard("toaster", 1, 3, 1, "");
  dut_.Heard("robot", 3, 3, 127, "");
  dut_.Heard("robot", -1, 3, -1, "");
  dut_.Take(kAnna, GetParametersRequest{});
  EXPECT_EQ(sent_.back().values, "head/look.age=2.0 robot/drive.speed=0.5 robot/drive.turn=1.0");
}

TEST_F(ParameterBoardTest, AFloodOfChangesWaitsOnlyUpToABound) {
  Know();
  for (std::size_t i = 0; i < ParameterBoard::kMostWaiting + 5; ++i)
    dut_.Take(kAnna, SetParametersRequest{{{"robot/drive.speed", 0.3}}, std::to_string(i)});
  EXPECT_THAT(sent_, SizeIs(5));
  dut_.Heard("robot", 1, 0.3, 0, "");
  EXPECT_THAT(sent_, SizeIs(ParameterBoard::kMostWaiting + 5));
}

}  // namespace
}  // namespace priamos::console
