#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/terminal/link_top.hpp"

namespace priamos::cli {
namespace {

const Time kStart = FromUtime(1'000'000'000);

link_channel_t Channel(const std::string& name, bool outgoing, int messages) {
  link_channel_t channel{};
  channel.channel = name;
  channel.outgoing = outgoing;
  channel.messages = messages;
  channel.bytes = 20 * messages;
  channel.expired = 2;
  channel.dropped = 5;
  channel.queue_age_s = 0.5F;
  return channel;
}

/// One of two reports that a link of two channels takes turns with.
link_status_t Report(int first, const link_channel_t& channel) {
  link_status_t report{};
  report.up = true;
  report.loss = 0.25;
  report.all_channels = 2;
  report.first_channel = static_cast<std::int8_t>(first);
  report.n_channels = 1;
  report.channels = {channel};
  return report;
}

TEST(LinkTopJson, BeforeTheFirstReportNothingIsHeard) {
  EXPECT_EQ(LinkTopView().Json(kStart), nlohmann::ordered_json({{"heard", false}}));
}

TEST(LinkTopJson, HoldsTheNewestReportAndItsAge) {
  LinkTopView dut;
  dut.Add(Report(0, Channel("POSE", true, 4)), kStart);
  const auto json = dut.Json(kStart + std::chrono::milliseconds(1500));
  EXPECT_TRUE(json.at("heard"));
  EXPECT_EQ(json.at("age_s"), 1.5);
  EXPECT_EQ(json.at("loss"), 0.25);
  EXPECT_FALSE(json.contains("first_channel")) << "all channels are there, not those of one report";
  EXPECT_FALSE(json.contains("n_channels"));
}

TEST(LinkTopJson, ChannelsOfAllReportsAreListed) {
  LinkTopView dut;
  dut.Add(Report(0, Channel("POSE", true, 4)), kStart);
  dut.Add(Report(1, Channel("ESTOP", false, 1)), kStart);
  const auto channels = dut.Json(kStart).at("channels");
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].at("channel"), "POSE");
  EXPECT_EQ(channels[0].at("outgoing"), true);
  EXPECT_EQ(channels[1].at("outgoing"), false);
  EXPECT_EQ(channels[1].at("expired"), 2);
  EXPECT_EQ(channels[1].at("dropped"), 5);
  EXPECT_EQ(channels[1].at("queue_age_s"), 0.5);
}

TEST(LinkTopJson, ARateThatIsNotKnownIsNull) {
  LinkTopView dut;
  dut.Add(Report(0, Channel("POSE", true, 4)), kStart);
  EXPECT_TRUE(dut.Json(kStart).at("channels")[0].at("messages_per_s").is_null());
  dut.Add(Report(0, Channel("POSE", true, 14)), kStart + std::chrono::seconds(2));
  const auto channel = dut.Json(kStart).at("channels")[0];
  EXPECT_EQ(channel.at("messages_per_s"), 5.0) << "10 more in 2 s";
  EXPECT_EQ(channel.at("bytes_per_s"), 100.0);
}

TEST(LinkTopJson, AfterARestartOfTheRadioTheOldRateIsNotCountedBackwards) {
  LinkTopView dut;
  dut.Add(Report(0, Channel("POSE", true, 100)), kStart);
  dut.Add(Report(0, Channel("POSE", true, 3)), kStart + std::chrono::seconds(1));
  const auto channel = dut.Json(kStart).at("channels")[0];
  EXPECT_TRUE(channel.at("messages_per_s").is_null());
  EXPECT_EQ(channel.at("messages"), 3);
}

}  // namespace
}  // namespace priamos::cli
