#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// test/support/groups: many cases share a process, and each is told as if it had one of its own.

namespace priamos {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class TestGroups : public ::testing::Test {
 protected:
  /// Runs cases of sample_cases.cpp, with 2 s for each.
  ShellAnswer Run(const std::string& cases, const std::string& environment = "") const {
    return RunShell(environment + " /usr/bin/python3 -B " + kTools + "run_cases.py " + kSamples + " " +
                    report_.string() + " 2 " + cases);
  }
  std::string Report(const std::string& ending = "") const {
    std::ostringstream text;
    text << std::ifstream(report_.string() + ending).rdbuf();
    return text.str();
  }
  static inline const std::string kSamples = "'" PRIAMOS_BINARY_DIR "/bin/sample_cases'";
  static inline const std::string kTools = "'" PRIAMOS_SOURCE_DIR "'/test/support/groups/";
  const TemporaryFolder folder_;
  const std::filesystem::path report_ = folder_ / "group.xml";
};

std::string Counts(int tests, int failures, int disabled, int skipped) {
  std::ostringstream head;
  head << "<testsuite tests=\"" << tests << "\" failures=\"" << failures << "\" disabled=\"" << disabled
       << "\" skipped=\"" << skipped << "\">";
  return head.str();
}

TEST_F(TestGroups, EveryCaseIsCounted) {
  const auto answer = Run("Good.Passes Good.IsSkipped Good.DISABLED_NeverRuns All/ByNumber.IsSmall/1");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(Report(), HasSubstr(Counts(4, 0, 1, 1)));
  EXPECT_EQ(answer.text, "4 cases, 0 failed\n");
}

TEST_F(TestGroups, WhatFailsIsNamedWithWhatItSaid) {
  const auto answer = Run("Good.Passes Bad.Fails");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(Report(), HasSubstr(Counts(2, 1, 0, 0)));
  EXPECT_THAT(answer.text, AllOf(HasSubstr("what it said"), HasSubstr("\nfailed: Bad.Fails\n")));
  EXPECT_THAT(answer.text, Not(HasSubstr("Good.Passes")));
}

TEST_F(TestGroups, ACrashIsAFailureOfItsCaseAndTheOthersRun) {
  const auto answer = Run("Good.PassesBehindATextWithoutEnd Bad.Dies Good.Passes Together.FindsNothing");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(Report(), HasSubstr(Counts(4, 1, 0, 0)));
  EXPECT_THAT(answer.text,
              AllOf(HasSubstr("its last words"), HasSubstr("Bad.Dies: the process was ended by SIGSEGV"),
                    HasSubstr("\nfailed: Bad.Dies\n4 cases, 1 failed\n")));
}

TEST_F(TestGroups, ACaseThatEndsTheProgramWithoutAReportHasFailed) {
  EXPECT_THAT(Run("Bad.EndsTheProgram Together.FindsNothing").text,
              AllOf(HasSubstr("ended with exit code 0"),
                    HasSubstr("\nfailed: Bad.EndsTheProgram\n2 cases, 1 failed")));
}

TEST_F(TestGroups, ACaseThatTakesTooLongIsEnded) {
  EXPECT_THAT(Run("Bad.Hangs Together.FindsNothing").text,
              AllOf(HasSubstr("took longer than 2 s"), HasSubstr("\nfailed: Bad.Hangs\n2 cases, 1 failed")));
}

TEST_F(TestGroups, WhoeverSpoilsTheEndOfTheProgramIsFound) {
  EXPECT_THAT(Run("Good.Passes Bad.EndsBadlyAfterAll Together.FindsNothing").text,
              AllOf(HasSubstr("exit code 23 after its last case"),
                    HasSubstr("\nfailed: Bad.EndsBadlyAfterAll\n3 cases, 1 failed")));
}

TEST_F(TestGroups, ACaseThatTheProgramDoesNotHaveHasFailed) {
  EXPECT_THAT(Run("Good.Passes Good.Gone").text, HasSubstr("failed: Good.Gone\n2 cases, 1 failed"));
}

TEST_F(TestGroups, WhatFailedRunsOnceMoreEachAlone) {
  Run("Bad.Fails Together.LeavesSomething Together.FindsNothing");
  EXPECT_THAT(Report(), HasSubstr(Counts(3, 2, 0, 0)));
  const auto again =
      Run("Bad.Fails Together.LeavesSomething Together.FindsNothing", "PRIAMOS_FAILED_ALONE=1");
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(Report(".again"), HasSubstr(Counts(2, 1, 0, 0)));
  EXPECT_THAT(again.text, HasSubstr("\nfailed: Bad.Fails\n2 cases, 1 failed"));
  EXPECT_THAT(Report(), HasSubstr(Counts(3, 2, 0, 0)));
}

TEST_F(TestGroups, EveryCaseOfAProgramIsInOneGroup) {
  const std::string script = (folder_ / "groups.cmake").string();
  const auto written =
      RunShell("/usr/bin/python3 -B " + kTools + "group_cases.py " + kSamples + " '*' sample reports 2 " +
               script + " && grep -o '\\[==\\[[A-Z][^]]*' " + script + " | cut -c5- | sort");
  EXPECT_EQ(written.exit_code, 0) << written.text;
  EXPECT_EQ(
      written.text,
      RunShell("sed -n 's/TEST(\\(.*\\), \\(.*\\)) {.*/\\1.\\2/p' " + kTools +
               "sample_cases.cpp | { cat; echo All/ByNumber.IsSmall/0; echo All/ByNumber.IsSmall/1; } | sort")
          .text);
  EXPECT_THAT(RunShell("cat " + script).text, ContainsRegex("add_test.sample_01 .*reports/sample_01.xml"));
}

/// In place of CTest: two groups and two cases, of which one group and one case fail, and only the case
/// passes alone.
constexpr const char* kCtest = R"(#!/bin/sh
echo "groups: $PRIAMOS_TEST_GROUPS; alone: $PRIAMOS_FAILED_ALONE"
case "$*" in *-R*) echo '<testsuite tests="1" failures="0" disabled="0" skipped="0">' >build/report.xml; exit 0 ;; esac
mkdir -p build/test/groups build/Testing/Temporary
group() { echo "<testsuite tests=\"$2\" failures=\"$3\" disabled=\"0\" skipped=\"$4\">"; cat; } >"build/test/groups/$1"
case "$*" in
  *--rerun-failed*)
    group a_01.xml.again 2 1 0 </dev/null
    echo '<testsuite tests="2" failures="1" disabled="0" skipped="0">' >build/again.xml ;;
  *)
    group a_01.xml 40 2 1 <<END
<testcase name="A.good" status="passed" time="0.1"></testcase>
<testcase name="A.bad" status="failed" time="0.1"><failure message=""/></testcase>
<testcase name="All/A.worse/3" status="failed" time="0.1"><failure message="SIGSEGV"/></testcase>
END
    group a_02.xml 10 0 0 </dev/null
    printf '1:a_01\n2:S.two\n' >build/Testing/Temporary/LastTestsFailed.log
    echo '<testsuite tests="4" failures="2" disabled="0" skipped="0">' >build/report.xml ;;
esac
exit 8
)";

TEST_F(TestGroups, TheClosingLineCountsCasesAndThoseThatFailAreNamed) {
  const auto clone = folder_ / "clone";
  std::filesystem::create_directories(clone / "build");
  std::filesystem::copy(PRIAMOS_SOURCE_DIR "/scripts", clone / "scripts");
  std::ofstream(clone / "scripts/build") << "#!/bin/sh\n";
  std::ofstream(folder_ / "ctest") << kCtest;
  const std::string run =
      "cd '" + clone.string() + "' && chmod +x ../ctest && PATH=\"$PWD/..:$PATH\" scripts/test";
  const auto all = RunShell(run);
  EXPECT_EQ(all.exit_code, 8) << all.text;
  EXPECT_THAT(all.text, HasSubstr("groups: 1; alone: \n"));
  EXPECT_THAT(all.text,
              HasSubstr("test: once more, alone: A.bad All/A.worse/3 S.two\ngroups: 1; alone: 1\n"));
  EXPECT_THAT(all.text, HasSubstr("\n50 passed, 1 failed, 1 skipped\n"));
  const auto some = RunShell(run + " -R A.bad");
  EXPECT_EQ(some.exit_code, 0) << some.text;
  EXPECT_THAT(some.text, HasSubstr("groups: ; alone: \n1 passed, 0 failed, 0 skipped\n"));
}

}  // namespace
}  // namespace priamos
