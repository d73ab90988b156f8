#include "cli/report/report_map_view.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>

namespace priamos::cli {
namespace {

constexpr drawing::Layer kLine{"line", "a line", {.line = drawing::Colour{0xff0000}, .width = 2}};
constexpr drawing::Layer kWall{"wall", "a wall", {.fill = drawing::Colour{0x000000}}};

std::vector<drawing::Text> TextsOf(const drawing::Drawing& page) {
  std::vector<drawing::Text> texts;
  for (const auto& shape : page.shapes())
    if (const auto* text = std::get_if<drawing::Text>(&shape.form)) texts.push_back(*text);
  return texts;
}

TEST(ReportMapView, MapPointsFallWhereTheScaleSays) {
  drawing::Drawing page(100, 60, {0xffffff});
  const MapView dut(page, {20, 10, 60, 40}, {5, 5}, 10);
  // Middle of the window (50, 30), 10 px right, 10 px up.
  EXPECT_EQ(dut.ToPage({6, 6}), Eigen::Vector2d(60, 20));
}

TEST(ReportMapView, ShapesAreClippedAtTheWindow) {
  drawing::Drawing page(100, 60, {0xffffff});
  MapView dut(page, {20, 10, 60, 40}, {0, 0}, 10);
  dut.Line(kLine, {{-50, 0}, {50, 0}});
  ASSERT_EQ(page.shapes().size(), 1u);
  EXPECT_DOUBLE_EQ(page.shapes()[0].clip->width, 60);
}

TEST(ReportMapView, ALineHasNoMorePointsThanCanBeSeen) {
  drawing::Drawing page(100, 60, {0xffffff});
  MapView dut(page, {0, 0, 100, 60}, {0, 0}, 10);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= 100000; ++i) points.emplace_back(i * 1e-5, 0);
  dut.Line(kLine, points);
  const auto& path = std::get<drawing::Path>(page.shapes().at(0).form);
  EXPECT_LT(path.points.size(), 20u);
  EXPECT_EQ(path.points.back(), dut.ToPage({1, 0}));
}

TEST(ReportMapView, LabelsStandOnNoWallAndNotOnEachOther) {
  drawing::Drawing page(400, 300, {0xffffff});
  MapView dut(page, {0, 0, 400, 300}, {0, 0}, 100);
  const Rectangle wall{{0, 0, 0.3}, {1.5, 0.1}};
  dut.Solid(kWall, wall);
  for (int i = 0; i < 6; ++i) dut.Label({0, 0}, "a label", {14}, {0}, 4);
  dut.SetLabels();
  const auto texts = TextsOf(page);
  ASSERT_EQ(texts.size(), 6u);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(texts[i].box().Overlaps(texts[k].box()));
    const auto box = texts[i].box();
    for (double x = -1.4; x <= 1.4; x += 0.1)
      EXPECT_FALSE(box.Holds(dut.ToPage(wall.map_from_centre * Eigen::Vector2d(x, 0))));
  }
}

TEST(ReportMapView, NamesStandOnWhatIsLargeEnough) {
  drawing::Drawing page(400, 300, {0xffffff});
  MapView dut(page, {0, 0, 400, 300}, {0, 0}, 100);
  dut.Name({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "table", {14}, {0});
  dut.Name({{-1, -1}, {-0.9, -1}, {-0.9, -0.9}, {-1, -0.9}}, "carton", {14}, {0});
  dut.SetLabels();
  const auto texts = TextsOf(page);
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_TRUE(texts[0].box().Holds(dut.ToPage({0.5, 0.5})));
  EXPECT_FALSE(texts[1].box().Holds(dut.ToPage({-0.95, -0.95})));
}

TEST(ReportMapView, EllipseHoldsItsStandardDeviations) {
  Eigen::Matrix2d covariance;
  covariance << 0.04, 0.01, 0.01, 0.09;
  for (const auto& point : EllipseOutline({1, 2}, covariance, 2)) {
    const Eigen::Vector2d d = point - Eigen::Vector2d(1, 2);
    EXPECT_NEAR(std::sqrt(d.dot(covariance.inverse() * d)), 2, 1e-9);
  }
}

}  // namespace
}  // namespace priamos::cli
