#include "cli/pages/report_comparison.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::cli {
namespace {

using support::ThrownReason;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

const Json kA{{"passed", true},
              {"contacts", 0},
              {"min_gap_m", 0.05},
              {"fixes", {{{"error_m", 0.01}}}},
              {"hand", nullptr}};
const Json kB{{"passed", false},
              {"contacts", 0},
              {"reason", "<stopped>"},
              {"min_gap_m", 0.03},
              {"fixes", Json::array()}};

class ReportComparison : public testing::Test {
 protected:
  std::string Run(const std::string& name, const std::string& summary) {
    const std::filesystem::path folder = folder_ / name;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "summary.json") << summary;
    std::ofstream(folder / "run.svg") << "<svg/>";
    return folder.string();
  }
  TemporaryFolder folder_;
};

TEST_F(ReportComparison, EveryFigureIsThereOnceWithItsDifference) {
  const auto dut = CompareSummaries(kA, kB);
  const auto of = [&](const std::string& key) {
    for (const ComparedFigure& figure : dut)
      if (figure.key == key) return figure;
    return ComparedFigure{};
  };
  EXPECT_EQ(dut.size(), 6u);
  EXPECT_EQ(of("min_gap_m").a, "0.05");
  EXPECT_EQ(of("min_gap_m").difference, "-0.02");
  EXPECT_EQ(of("contacts").difference, "") << "equal";
  EXPECT_EQ(of("fixes[0].error_m").b, "") << "the other run had none";
  EXPECT_EQ(of("reason").a, "");
  EXPECT_EQ(of("passed").b, "false");
}

TEST_F(ReportComparison, ThePageHasBothPlansAndNothingThatARunCouldHaveWrittenIntoIt) {
  const std::string page = ComparisonPage({"first", kA, "<svg/>"}, {"<second>", kB, ""});
  EXPECT_THAT(page, HasSubstr("PHN2Zy8+"));
  EXPECT_THAT(page, HasSubstr("&lt;second&gt;"));
  EXPECT_THAT(page, HasSubstr("&lt;stopped&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<stopped>")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST_F(ReportComparison, TheVerbWritesItOnce) {
  const std::string a = Run("a", kA.dump()), b = Run("b", kB.dump()), page = folder_ / "two.html";
  const auto answer = Priamos({"report", a, b + "/", "--out", page});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("4 of 6 figures differ"));
  EXPECT_THAT(FileContent(page), HasSubstr("<th>b</th>"));
  EXPECT_EQ(Priamos({"report", a, b, "--out", page}).exit_code, 2) << "it is there already";
  EXPECT_EQ(Priamos({"report", a, b, "--out", page, "--force"}).exit_code, 0);
}

TEST_F(ReportComparison, AFolderThatIsNoRunIsNamed) {
  EXPECT_THAT(ThrownReason([&] { LoadComparedRun(folder_ / "nowhere"); }),
              HasSubstr("summary.json: expected the summary of one run"));
  EXPECT_THAT(ThrownReason([&] { LoadComparedRun(Run("many", "[]")); }), HasSubstr("expected the summary"));
}

}  // namespace
}  // namespace priamos::cli
