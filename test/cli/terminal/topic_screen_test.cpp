#include "cli/terminal/topic_screen.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<TopicRow> Rows(int n) {
  std::vector<TopicRow> rows;
  for (int i = 0; i < n; ++i)
    rows.push_back({.channel = "A_CHANNEL_OF_THE_ROBOT_" + std::to_string(i),
                    .type = "priamos.a_type_t",
                    .messages = 1234567,
                    .rate_hz = 99.98});
  return rows;
}

const BusLosses kLosses{{{0x7f000001'1234, 1000, 3}, {0x7f000001'1235, 1000, 0}}, 3, 0, 0};

void ExpectFits(const std::string& text, ScreenSize size) {
  std::istringstream lines(text);
  int n = 0;
  for (std::string line; std::getline(lines, line); ++n) EXPECT_LE(Characters(line), size.columns) << line;
  EXPECT_LE(n, size.rows) << text;
}

TEST(TopicScreen, FitsEveryTerminalAndKeepsHeaderAndLosses) {
  for (const ScreenSize size : {ScreenSize{80, 24}, {40, 12}, {200, 50}, {60, 16}}) {
    const std::string dut = TopicScreen(Rows(30), kLosses, size);
    ExpectFits(dut, size);
    EXPECT_THAT(dut, testing::StartsWith("channel"));
    EXPECT_THAT(dut, HasSubstr("lost: 3 datagrams"));
  }
}

TEST(TopicScreen, RateStaysLongerThanJitter) {
  const std::string dut = TopicScreen(Rows(3), kLosses, ScreenSize{60, 24});
  EXPECT_THAT(dut, HasSubstr("rate Hz"));
  EXPECT_THAT(dut, HasSubstr("bytes/s"));
  EXPECT_THAT(dut, Not(HasSubstr("jitter")));
  EXPECT_THAT(dut, Not(HasSubstr("undecodable")));
}

TEST(TopicScreen, WhatCannotBeDecodedIsShownAlsoWhereThereIsLittleRoom) {
  auto rows = Rows(3);
  rows[1].undecodable = 7;
  EXPECT_THAT(TopicScreen(rows, kLosses, ScreenSize{60, 24}), HasSubstr("undecodable"));
}

TEST(TopicScreen, ChannelsThatDoNotFitAreCounted) {
  EXPECT_THAT(TopicScreen(Rows(30), kLosses, ScreenSize{80, 24}), HasSubstr("... 9 more"));
}

TEST(TopicScreen, WithoutATerminalNothingIsLeftOut) {
  const std::string dut = TopicScreen(Rows(30), kLosses, {});
  EXPECT_THAT(dut, HasSubstr("A_CHANNEL_OF_THE_ROBOT_29"));
  EXPECT_THAT(dut, HasSubstr("undecodable"));
  EXPECT_THAT(dut, HasSubstr("sender"));
}

}  // namespace
}  // namespace priamos::cli
