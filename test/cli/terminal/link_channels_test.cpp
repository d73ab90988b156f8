#include "cli/terminal/link_channels.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using testing::EndsWith;

/// A report of some channels of three; one that begins with '<' is sent by this end.
link_status_t Report(const std::vector<std::string>& names) {
  link_status_t report{};
  report.all_channels = 3;
  for (const std::string& name : names) {
    link_channel_t channel{};
    channel.outgoing = name[0] == '<' ? 1 : 0;
    channel.channel = name.substr(channel.outgoing);
    report.channels.push_back(channel);
  }
  report.n_channels = static_cast<std::int8_t>(report.channels.size());
  return report;
}

TEST(LinkChannelsTest, AChannelThatTheLinkDoesNotHaveIsAnsweredWithThoseOfTheOtherEnd) {
  LinkChannels dut;
  dut.Add(Report({"POSE", "SONAR_RANGES"}));
  EXPECT_FALSE(dut.WhyNot("NOPE")) << "not all are known";
  dut.Add(Report({"<GOAL"}));
  EXPECT_EQ(dut.WhyNot("NOPE"),
            "channel: expected one that the other end of the link sends (POSE, SONAR_RANGES), got \"NOPE\"");
  EXPECT_THAT(dut.WhyNot("SONAR_RANGE").value_or(""), EndsWith("nearest: \"SONAR_RANGES\""));
  EXPECT_FALSE(dut.WhyNot("SONAR_RANGES"));
}

TEST(LinkChannelsTest, WhatThisEndSendsCannotBeAskedFor) {
  LinkChannels dut;
  dut.Add(Report({"<GOAL"}));
  EXPECT_EQ(dut.WhyNot("GOAL"),
            "channel: expected one that the other end sends, got \"GOAL\", which this end sends");
}

TEST(LinkChannelsTest, WithoutAReportNothingIsRefused) {
  const LinkChannels dut;
  EXPECT_TRUE(dut.empty());
  EXPECT_FALSE(dut.complete());
  EXPECT_FALSE(dut.WhyNot("NOPE"));
}

}  // namespace
}  // namespace priamos::cli
