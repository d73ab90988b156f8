#include "cli/report/report_html.hpp"

#include <gmock/gmock.h>

#include <regex>
#include <vector>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string Page(const RunRecord& record) {
  return ReportPage(record, Summarise(record, TestInfo()), "foobar");
}

TEST(ReportHtml, ShowsFiguresPictureAndPhases) {
  const std::string dut = Page(SyntheticRun{}.Record());
  EXPECT_THAT(dut, HasSubstr("passed, nothing touched"));
  EXPECT_THAT(dut, HasSubstr("data:image/svg+xml;base64,Zm9vYmFy"));
  EXPECT_THAT(dut, HasSubstr("<td>15.0 cm</td><td>4.00&deg;</td>"));
  EXPECT_THAT(dut, HasSubstr("<td>0.1 s</td><td>approaching</td>"));
  EXPECT_THAT(dut, HasSubstr("<td>POSE</td>"));
}

TEST(ReportHtml, AFailureIsShownWithItsReasonAndSeed) {
  SyntheticRun run;
  run.done = false;
  RunInfo info = TestInfo();
  info.seed = 4711;
  info.reason = "time limit of 180 s reached while: <waiting>";
  const RunRecord record = run.Record();
  const std::string dut = ReportPage(record, Summarise(record, info), "foobar");
  EXPECT_THAT(dut, HasSubstr("seed 4711"));
  EXPECT_THAT(dut, HasSubstr("<p class=\"reason\">time limit of 180 s reached while: &lt;waiting&gt;</p>"));
  EXPECT_THAT(dut, HasSubstr("<td>end</td><td>not passed: time limit of 180 s reached"));
}

TEST(ReportHtml, WithoutAPlannerTheMissionIsWhatWasTold) {
  RunInfo info = TestInfo();
  info.reason = "time limit of 180 s reached on the way to waypoint 2";
  info.story = {{3.2, "the operator takes the space-mouse"}, {9.5, "at waypoint 1 of 3"}};
  const std::string dut = ReportPage(RunRecord{}, Summarise(RunRecord{}, info), "foobar");
  EXPECT_THAT(dut, HasSubstr("<td>3.2 s</td><td>the operator takes the space-mouse</td>"));
  EXPECT_THAT(dut, HasSubstr("<td>9.5 s</td><td>at waypoint 1 of 3</td>"));
  EXPECT_THAT(dut,
              HasSubstr("<td>end</td><td>not passed: time limit of 180 s reached on the way to waypoint 2"));
}

TEST(ReportHtml, NeedsNothingFromOutsideAndRunsNothing) {
  const std::string dut = Page(SyntheticRun{}.Record());
  EXPECT_THAT(dut, Not(HasSubstr("http")));
  EXPECT_THAT(dut, Not(HasSubstr("<script")));
  EXPECT_THAT(dut, Not(HasSubstr("@import")));
}

TEST(ReportHtml, EveryElementIsClosed) {
  const std::string dut = Page(SyntheticRun{}.Record());
  for (const std::string tag :
       {"table", "tr", "td", "th", "div", "svg", "text", "main", "span", "h2", "header"}) {
    const std::regex open("<" + tag + "[ >]"), close("</" + tag + ">");
    const auto count = [&](const std::regex& pattern) {
      return std::distance(std::sregex_iterator(dut.begin(), dut.end(), pattern), std::sregex_iterator());
    };
    EXPECT_EQ(count(open), count(close)) << tag;
  }
}

TEST(ReportHtml, TextFromTheBusIsEscaped) {
  RunRecord record = SyntheticRun{}.Record();
  record.mission[0].text = "<img src=x>";
  record.onboard_link.back().channels[0].channel = "<b>";
  const std::string dut = Page(record);
  EXPECT_THAT(dut, Not(HasSubstr("<img src=x>")));
  EXPECT_THAT(dut, Not(HasSubstr("<b></td>")));
  EXPECT_THAT(dut, HasSubstr("&lt;img src=x&gt;"));
}

TEST(ReportHtml, ADriveByHandShowsNoFixesAndNoLooks) {
  Summary summary = Summarise(RunRecord{}, TestInfo());
  summary.hand = HandSummary{.wished_s = 20, .free_m = 10, .achieved_m = 9.4, .longest_stop_s = 0.5};
  const std::string dut = ReportPage(RunRecord{}, summary, "");
  EXPECT_THAT(dut, HasSubstr("<b>94.0 %</b>"));
  EXPECT_THAT(dut, HasSubstr("<b>0.5 s</b>"));
  EXPECT_THAT(dut, Not(HasSubstr("door plane")));
  EXPECT_THAT(dut, Not(HasSubstr("<h2>Fixes")));
  EXPECT_THAT(dut, Not(HasSubstr("<h2>Looks")));
}

TEST(ReportHtml, EmptyRecordGivesAPage) {
  const std::string dut = Page(RunRecord{});
  EXPECT_THAT(dut, HasSubstr("not passed"));
  EXPECT_THAT(dut, HasSubstr("no fix corrected the pose"));
  EXPECT_THAT(dut, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace priamos::cli
