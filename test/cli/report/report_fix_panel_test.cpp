#include "cli/report/report_fix_panel.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

using drawing::Circle;
using drawing::Drawing;
using drawing::Path;
using drawing::Shape;
using Eigen::Vector2d;

constexpr drawing::Box kWindow{100, 50, 520, 520};

Drawing Drawn(const RunRecord& record) {
  Drawing page(800, 800, {0xffffff});
  DrawFixErrors(page, kWindow, record);
  return page;
}

std::vector<std::string> TextsOf(const Drawing& page) {
  std::vector<std::string> texts;
  for (const Shape& shape : page.shapes())
    if (const auto* text = std::get_if<drawing::Text>(&shape.form)) texts.push_back(text->text);
  return texts;
}

std::vector<const Shape*> ShapesOf(const Drawing& page, std::string_view layer) {
  std::vector<const Shape*> shapes;
  for (const Shape& shape : page.shapes())
    if (shape.layer != nullptr && shape.layer->id == layer) shapes.push_back(&shape);
  return shapes;
}

Vector2d CentreOf(const Shape& shape) {
  return std::get<Circle>(shape.form).centre;
}

TEST(ReportFixPanel, WithoutAFixItSaysSo) {
  EXPECT_THAT(TextsOf(Drawn(RunRecord())), testing::ElementsAre("no fix corrected the pose"));
}

TEST(ReportFixPanel, EveryFixHasItsNumberAndItsEllipse) {
  const Drawing dut = Drawn(SyntheticRun().Record());
  EXPECT_THAT(TextsOf(dut), testing::IsSupersetOf({"1", "2"}));
  EXPECT_EQ(ShapesOf(dut, "no-error").size(), 1u);
  EXPECT_EQ(ShapesOf(dut, "error-before").size(), 1u) << "before the first fix only";
}

/// The largest error is (0.09, -0.12) m, 15 cm; rings of 5 cm hold it in five, and so the scale is known.
TEST(ReportFixPanel, TheErrorBeforeTheFirstFixLiesWhereTheScaleSays) {
  const Drawing dut = Drawn(SyntheticRun().Record());
  const double px_per_m = kWindow.width / (10.4 * 0.05);
  const Vector2d none = CentreOf(*ShapesOf(dut, "no-error").at(0));
  EXPECT_NEAR(none.x(), kWindow.x + kWindow.width / 2, 1e-9);
  EXPECT_NEAR(none.y(), kWindow.y + kWindow.height / 2, 1e-9);
  const Vector2d before = CentreOf(*ShapesOf(dut, "error-before").at(0)) - none;
  EXPECT_NEAR(before.x(), 0.09 * px_per_m, 2) << "believed too far ahead";
  EXPECT_NEAR(before.y(), 0.12 * px_per_m, 2) << "y of the map is up, of the page down";
}

TEST(ReportFixPanel, RingsAreNamedInCentimetres) {
  EXPECT_THAT(TextsOf(Drawn(SyntheticRun().Record())), testing::IsSupersetOf({"10 cm", "20 cm"}));
}

TEST(ReportFixPanel, NothingIsDrawnFarOutsideTheWindow) {
  const Drawing dut = Drawn(SyntheticRun().Record());
  for (const Shape& shape : dut.shapes()) {
    const auto* path = std::get_if<Path>(&shape.form);
    if (path == nullptr || shape.clip) continue;
    for (const Vector2d& point : path->points) {
      EXPECT_GE(point.x(), kWindow.x - 1);
      EXPECT_LE(point.x(), kWindow.x + kWindow.width + 1);
    }
  }
}

TEST(ReportFixPanel, AFixWithoutTheTruthIsLeftOut) {
  RunRecord record = SyntheticRun().Record();
  record.truth.clear();
  EXPECT_THAT(TextsOf(Drawn(record)), testing::ElementsAre("no fix corrected the pose"));
}

}  // namespace
}  // namespace priamos::cli
