#include "common/drawing/drawing.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "common/drawing/legend.hpp"
#include "common/drawing/raster.hpp"
#include "common/drawing/svg.hpp"

namespace priamos::drawing {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr Layer kRed{"red", "a red line", {.line = Colour{0xff0000}, .width = 4}};
constexpr Layer kArea{"area", "a half-black area", {.fill = Colour{0x000000}, .opacity = 0.5}, Symbol::kArea};
constexpr Layer kPlain{"plain", ""};

TEST(Drawing, ShapesFallWhereTheirPixelsSay) {
  Drawing page(100, 60, {0xffffff});
  page.Line(kRed, {10, 30}, {90, 30});
  page.FillBox(kArea, {20, 40, 10, 10});
  const Raster dut = Paint(page);
  EXPECT_EQ(dut.width, 100);
  EXPECT_EQ(dut.At(50, 30) & 0xffffff, 0xff0000u);
  EXPECT_EQ(dut.At(50, 36) & 0xffffff, 0xffffffu);
  EXPECT_NEAR(dut.At(25, 45) & 0xff, 128, 2);
}

TEST(Drawing, ScaleEnlargesTheWholePage) {
  Drawing page(100, 60, {0xffffff});
  page.Line(kRed, {10, 30}, {90, 30});
  const Raster dut = Paint(page, 3);
  EXPECT_EQ(dut.width, 300);
  EXPECT_EQ(dut.height, 180);
  EXPECT_EQ(dut.At(150, 90) & 0xffffff, 0xff0000u);
}

TEST(Drawing, NothingIsSeenOutsideItsWindow) {
  Drawing page(100, 60, {0xffffff});
  page.Add(kRed, Path{{{0, 30}, {100, 30}}, false}, Box{20, 0, 40, 60});
  const Raster dut = Paint(page);
  EXPECT_EQ(dut.At(10, 30) & 0xffffff, 0xffffffu);
  EXPECT_EQ(dut.At(40, 30) & 0xffffff, 0xff0000u);
  EXPECT_THAT(ToSvg(page), HasSubstr("clip-path=\"url(#window0)\""));
}

TEST(Drawing, WhatIsNoNumberIsLeftOut) {
  Drawing page(100, 60, {0xffffff});
  page.Line(kRed, {NAN, 30}, {90, 30});
  page.Add(kRed, Circle{{10, 10}, INFINITY});
  page.Add(kRed, Path{{{1e300, 0}, {0, 0}}, false});
  EXPECT_TRUE(page.shapes().empty());
}

TEST(Drawing, TextCoversWhatWasMeasured) {
  Drawing page(300, 60, {0xffffff});
  const Box box = page.Write(kPlain, {20, 40}, "Grüße: 5 cm", {20}, {0x000000});
  const Raster dut = Paint(page);
  int inside = 0, outside = 0;
  for (int y = 0; y < dut.height; ++y)
    for (int x = 0; x < dut.width; ++x)
      if ((dut.At(x, y) & 0xff) < 128) ++(box.Grown(1).Holds(Eigen::Vector2d(x, y)) ? inside : outside);
  EXPECT_GT(inside, 200);
  EXPECT_EQ(outside, 0);
  EXPECT_GT(box.width, MeasureText("Grüße", {20}).width);
  EXPECT_GT(MeasureText("Grüße", {20, true}).width, MeasureText("Grüße", {20}).width);
}

TEST(Drawing, TextMeasuresTheSameAtEverySize) {
  const double small = MeasureText("smallest gap 5.5 cm", {10}).width;
  EXPECT_NEAR(MeasureText("smallest gap 5.5 cm", {40}).width, 4 * small, 0.02 * small);
}

TEST(Drawing, LegendHoldsEveryLayerThatIsDrawnAndNoOther) {
  Drawing page(500, 200, {0xffffff});
  page.FillBox(kArea, {0, 0, 10, 10});
  page.Line(kRed, {0, 0}, {10, 10});
  page.Write(kPlain, {0, 50}, "explains itself", {12}, {0x000000});
  const double height = WriteLegend(page, 10, 60, 480, {{12}, {0x000000}});
  EXPECT_GT(height, 0);
  std::vector<std::string> legend;
  for (const Shape& shape : page.shapes())
    if (const auto* text = std::get_if<Text>(&shape.form); text && shape.layer->id == "legend")
      legend.push_back(text->text);
  EXPECT_THAT(legend, ElementsAre("a half-black area", "a red line"));
}

TEST(Drawing, NarrowLegendsAreHigher) {
  Drawing page(500, 200, {0xffffff});
  page.FillBox(kArea, {0, 0, 10, 10});
  page.Line(kRed, {0, 0}, {10, 10});
  Drawing narrow = page;
  EXPECT_LT(WriteLegend(page, 0, 0, 500, {{12}, {0}}), WriteLegend(narrow, 0, 0, 160, {{12}, {0}}));
}

TEST(Svg, TextIsTextAndEscaped) {
  Drawing page(100, 60, {0xffffff});
  page.Write(kPlain, {5, 20}, "<b> & \"c\"", {12}, {0x123456});
  const std::string dut = ToSvg(page);
  EXPECT_THAT(dut, HasSubstr(">&lt;b&gt; &amp; &quot;c&quot;</text>"));
  EXPECT_THAT(dut, HasSubstr("fill=\"#123456\""));
  EXPECT_THAT(dut, HasSubstr("textLength="));
}

TEST(Svg, ControlCharactersBecomeBlanks) {
  EXPECT_EQ(EscapeMarkup("<b a=\"&\n\">"), "&lt;b a=&quot;&amp; &quot;&gt;");
}

TEST(Svg, ShapesOfALayerAreAGroup) {
  Drawing page(100, 60, {0xffffff});
  page.Line(kRed, {0, 0}, {10, 10});
  page.Line(kRed, {0, 10}, {10, 0});
  page.FillBox(kArea, {0, 0, 10, 10});
  const std::string dut = ToSvg(page);
  EXPECT_THAT(dut, HasSubstr("<g class=\"red\">\n<polyline"));
  EXPECT_THAT(dut, HasSubstr("fill-opacity=\"0.5\""));
  EXPECT_EQ(dut.find("<g class=\"red\">"), dut.rfind("<g class=\"red\">"));
}

TEST(Png, HasItsSignatureAndSize) {
  const std::string dut = ToPng(Raster(3, 2, {0x808080}));
  EXPECT_EQ(dut.substr(1, 3), "PNG");
  EXPECT_EQ(dut[19], 3);
  EXPECT_EQ(dut[23], 2);
}

}  // namespace
}  // namespace priamos::drawing
