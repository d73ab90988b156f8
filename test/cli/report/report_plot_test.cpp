#include "cli/report/report_plot.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace priamos::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReportPlot, LineRunsFromCornerToCornerOfTheAxes) {
  const std::string dut = ToSvg({"way", "m", {{"x", "red", {{0, 0}, {10, 4}}, false}}, {}, 10});
  // Left and right end of the time axis, bottom and top of the y axis.
  EXPECT_THAT(dut, HasSubstr("points=\"46.0,202.0 388.0,52.0 \""));
}

TEST(ReportPlot, AxisHasRoundNumbers) {
  const std::string dut = ToSvg({"way", "m", {{"x", "red", {{0, 0}, {10, 3.7}}, false}}, {}, 10});
  for (const char* number : {">0<", ">1<", ">2<", ">3<", ">4<"}) EXPECT_THAT(dut, HasSubstr(number));
}

TEST(ReportPlot, SpansAreShadedAndNamed) {
  const std::string dut = ToSvg({"way", "m", {}, {{2, 4, "fix"}}, 10});
  EXPECT_THAT(dut, HasSubstr("<rect class=\"span\" x=\"114.4\""));
  EXPECT_THAT(dut, HasSubstr(">fix</text>"));
}

TEST(ReportPlot, PointsThatAreNotNumbersAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string dut = ToSvg({"way", "m", {{"x", "red", {{0, 1}, {5, nan}, {10, 1}}, false}}, {}, 10});
  EXPECT_THAT(dut, Not(HasSubstr("nan")));
}

TEST(ReportPlot, NoDataStillGivesAxes) {
  EXPECT_THAT(ToSvg({"way", "m", {}, {}, 0}), Not(HasSubstr("nan")));
}

TEST(ReportPlot, LongSeriesAreThinned) {
  PlotSeries series{"x", "red", {}, false};
  for (int i = 0; i < 100000; ++i) series.points.emplace_back(i, 1);
  EXPECT_LT(ToSvg({"way", "m", {series}, {}, 100000}).size(), 20000u);
}

TEST(ReportPlot, TextFromOutsideCannotBecomeMarkup) {
  EXPECT_THAT(ToSvg({"<script>", "m", {}, {}, 1}), Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace priamos::cli
