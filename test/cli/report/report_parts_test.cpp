#include "cli/report/report_parts.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Base64, VectorsOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe\xfd"), "//79");
}

TEST(ReportParts, WhatPeopleWroteIsNoMarkup) {
  EXPECT_THAT(PageHead("<b>", true, "a & b"),
              AllOf(HasSubstr("<h1>&lt;b&gt;</h1>"), HasSubstr("verdict good\">a &amp; b</span>")));
  RunRecord record;
  alarm_t alarm{};
  alarm.utime = 3'000'000;
  alarm.severity = alarm_t::CRITICAL;
  alarm.source = "<i>";
  alarm.text = "<script>";
  record.alarms.push_back(alarm);
  EXPECT_THAT(AlarmTable(record, 1'000'000),
              HasSubstr("<td>2.0 s</td><td>critical</td><td>&lt;i&gt;</td><td>&lt;script&gt;</td><td></td>"));
  EXPECT_EQ(AlarmTable({}, 0), "");
}

TEST(ReportParts, WithoutTruthSigmasAndBelievedSpeedArePlotted) {
  RunRecord record;
  for (int i = 0; i < 5; ++i) {
    pose_t pose{};
    pose.utime = i * 1'000'000;
    pose.vx_m_s = 0.3;
    pose.sigma_x_m = 0.05;
    record.poses.push_back(pose);
  }
  const std::string plots = Plots(record, {0, 4'000'000, false});
  EXPECT_THAT(plots, AllOf(HasSubstr("2 sigma"), HasSubstr("believed speed")));
}

}  // namespace
}  // namespace priamos::cli
