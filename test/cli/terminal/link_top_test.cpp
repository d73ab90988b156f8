#include "cli/terminal/link_top.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

const Time kStart = FromUtime(1'000'000'000);

link_status_t Report(int first, int messages) {
  link_status_t report{};
  report.up = report.onboard = true;
  report.utilisation = 0.5;
  report.round_trip_s = -1;
  report.all_channels = 2;
  report.first_channel = static_cast<std::int8_t>(first);
  report.n_channels = 1;
  link_channel_t channel{};
  channel.channel = first == 0 ? "POSE" : "DRIVE_COMMAND";
  channel.outgoing = first == 0;
  channel.messages = messages;
  channel.late = 3;
  report.channels = {channel};
  return report;
}

TEST(LinkTopView, SaysWhatIsMissing) {
  EXPECT_THAT(LinkTopView().Render(kStart, {}), HasSubstr("is priamos-radio running"));
}

TEST(LinkTopView, PutsReportsTogetherAndCountsPerSecond) {
  LinkTopView dut;
  for (int i = 0; i < 3; ++i) {
    dut.Add(Report(0, 8 * i), kStart + std::chrono::seconds(2 * i));
    dut.Add(Report(1, 0), kStart + std::chrono::seconds(2 * i + 1));
  }
  const std::string text = dut.Render(kStart + std::chrono::seconds(5), {});
  EXPECT_THAT(text, HasSubstr("onboard end: up"));
  EXPECT_THAT(text, HasSubstr("[############............]  50 %"));
  EXPECT_THAT(text, HasSubstr("round trip -"));
  EXPECT_THAT(text, testing::ContainsRegex("up +POSE +4.0"));
  EXPECT_THAT(text, testing::ContainsRegex("down +DRIVE_COMMAND +0.0"));
}

TEST(LinkTopView, ARateNeedsTwoReports) {
  LinkTopView dut;
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(dut.complete());
    dut.Add(Report(0, 8 * i), kStart + std::chrono::seconds(2 * i));
    EXPECT_THAT(dut.Render(kStart + std::chrono::seconds(2), {}),
                testing::ContainsRegex(i == 0 ? "up +POSE +- +- " : "up +POSE +4.0"));
    dut.Add(Report(1, 0), kStart + std::chrono::seconds(2 * i + 1));
  }
  EXPECT_TRUE(dut.complete());
}

TEST(LinkTopView, TroubleIsSaidFirst) {
  LinkTopView dut;
  link_status_t report = Report(0, 1);
  report.alarm = true;
  dut.Add(report, kStart);
  EXPECT_THAT(dut.Render(kStart, {}), HasSubstr("ALARM"));
  EXPECT_THAT(dut.Render(kStart + std::chrono::seconds(4), {}), HasSubstr("SILENT"));
  report.alarm = false;
  report.up = false;
  dut.Add(report, kStart);
  EXPECT_THAT(dut.Render(kStart, {}), HasSubstr("DOWN"));
}

TEST(LinkTopView, ARestartOfTheRadioIsNoNegativeRate) {
  LinkTopView dut;
  dut.Add(Report(0, 100), kStart);
  dut.Add(Report(0, 2), kStart + std::chrono::seconds(1));
  EXPECT_THAT(dut.Render(kStart + std::chrono::seconds(1), {}), Not(HasSubstr("-98")));
}

TEST(LinkTopView, FitsATerminalAndKeepsTheTablesHeader) {
  for (const ScreenSize size : {ScreenSize{80, 24}, {40, 12}, {200, 50}}) {
    LinkTopView dut;
    for (int i = 0; i < 20; ++i) {
      link_status_t report = Report(0, 16'000'000);
      report.all_channels = 20;
      report.first_channel = static_cast<std::int8_t>(i);
      report.channels[0].channel = "A_CHANNEL_WITH_A_LONG_NAME";
      report.bytes_sent = report.bytes_received = 123'456'789;
      dut.Add(report, kStart);
    }
    const std::string text = dut.Render(kStart, size);
    std::istringstream lines(text);
    int n = 0;
    for (std::string line; std::getline(lines, line); ++n) EXPECT_LE(Characters(line), size.columns) << line;
    EXPECT_LE(n, size.rows) << text;
    EXPECT_THAT(text, HasSubstr("channel"));
    // Beside names of 26 letters, 40 columns have room for what is worth most.
    EXPECT_THAT(text, HasSubstr(size.columns < 80 ? "B/s" : "msg/s"));
    EXPECT_EQ(text.find(" more\n") != std::string::npos, size.rows < 24 + 4) << text;
  }
}

}  // namespace
}  // namespace priamos::cli
