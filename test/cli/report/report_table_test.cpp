#include "cli/report/report_table.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string Printed(const Summary& summary) {
  std::ostringstream out;
  PrintSummary(out, summary);
  return out.str();
}

TEST(ReportTable, ShowsTheFiguresOfAPassedRun) {
  const std::string dut = Printed(Summarise(SyntheticRun{}.Record(), TestInfo()));
  EXPECT_THAT(dut, HasSubstr("door, seed 7: passed, nothing touched after 18.0 s"));
  EXPECT_THAT(dut, HasSubstr("15.0 cm 4.00 deg"));
  EXPECT_THAT(dut, HasSubstr("1.0 cm 0.20 deg"));
  EXPECT_THAT(dut, HasSubstr("+0.6 cm lateral, +0.23 deg heading"));
  EXPECT_THAT(dut, HasSubstr("5.2 cm, 0 contacts"));
  EXPECT_THAT(dut, HasSubstr("20 % of the line"));
  EXPECT_THAT(dut, HasSubstr("0.18 s old"));
}

TEST(ReportTable, ADriveByHandIsJudgedByWhatItsOperatorWished) {
  Summary summary;
  summary.hand = HandSummary{.wished_s = 20, .free_m = 10, .achieved_m = 9.4, .longest_stop_s = 0.5};
  const std::string dut = Printed(summary);
  EXPECT_THAT(dut, HasSubstr("of the motion that was truly free 94.0 % was honoured"));
  EXPECT_THAT(dut, HasSubstr("longest stop in the passage while pushed: 0.5 s"));
  EXPECT_THAT(dut, HasSubstr("smallest gap"));
  EXPECT_THAT(dut, Not(HasSubstr("door plane")));
  EXPECT_THAT(dut, Not(HasSubstr("fix")));
  summary.fixes.emplace_back();
  EXPECT_THAT(Printed(summary), HasSubstr("door plane"));
}

TEST(ReportTable, ThingsThatTheHeadSawAreShownWhenAnyWereTold) {
  Summary summary;
  EXPECT_THAT(Printed(summary), Not(HasSubstr("things")));
  summary.things =
      FoundObjects{.edges = 1, .faces = 2, .boxes = 3, .standing = 5, .phantoms = 1, .front_p95_m = 0.043};
  const std::string dut = Printed(summary);
  EXPECT_THAT(dut, HasSubstr("6: 3 boxes, 2 faces, 1 edges"));
  EXPECT_THAT(dut, HasSubstr("5, and 1 where no surface is within 10 cm"));
  EXPECT_THAT(dut, HasSubstr("95 % within 4.3 cm of a true surface, less the error of the pose"));
}

TEST(ReportTable, SaysWhatIsMissing) {
  const std::string dut = Printed(Summarise(RunRecord{}, TestInfo()));
  EXPECT_THAT(dut, HasSubstr("not passed"));
  EXPECT_THAT(dut, HasSubstr("no fix corrected the pose"));
  EXPECT_THAT(dut, HasSubstr("- lateral, - heading"));
}

TEST(ReportTable, NoLineIsWiderThanATerminal) {
  std::istringstream lines(Printed(Summarise(SyntheticRun{}.Record(), TestInfo())));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(ReportTable, VerdictCountsContacts) {
  Summary summary;
  summary.passed = true;
  EXPECT_EQ(Verdict(summary), "passed, nothing touched");
  summary.contacts = 1;
  EXPECT_EQ(Verdict(summary), "passed, one contact");
  summary.passed = false;
  summary.contacts = 3;
  EXPECT_EQ(Verdict(summary), "not passed, 3 contacts");
}

}  // namespace
}  // namespace priamos::cli
