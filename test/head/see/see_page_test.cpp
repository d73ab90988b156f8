#include "head/see/see_page.hpp"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace priamos::head {
namespace {

constexpr drawing::Layer kEdge{"edge", "an edge", {.line = drawing::Colour{0x00ff00}, .width = 2}};
constexpr drawing::Layer kCorner{
    "corner", "a corner", {.line = drawing::Colour{0xff0000}}, drawing::Symbol::kDot};

SeePage PageOf(int width, int height, int images = 1) {
  return SeePage(std::vector<cv::Mat>(static_cast<std::size_t>(images),
                                      cv::Mat(height, width, CV_8UC1, cv::Scalar(128))));
}

cv::Mat Decoded(const SeePage& page) {
  const std::string png = page.ToPng();
  return cv::imdecode(std::vector<unsigned char>(png.begin(), png.end()), cv::IMREAD_COLOR);
}

/// Rows of pixels that a level line covers.
int Thickness(int width, int height) {
  SeePage page = PageOf(width, height);
  page.Line(kEdge, 0, {0, height / 2.0}, {width - 1.0, height / 2.0});
  page.Finish();
  const cv::Mat image = Decoded(page);
  int rows = 0;
  for (int y = 0; y < height; ++y) rows += image.at<cv::Vec3b>(y, width / 2)[1] > 200;
  return rows;
}

TEST(SeePage, LinesGrowWithTheImage) {
  EXPECT_LE(Thickness(320, 240), 2);
  EXPECT_NEAR(Thickness(640, 480), 2, 1);
  EXPECT_NEAR(Thickness(3200, 2400), 10, 1);
}

TEST(SeePage, ImagesStandSideBySideAndALineStaysInItsOwn) {
  SeePage dut = PageOf(100, 80, 2);
  dut.Line(kEdge, 1, {-50, 40}, {50, 40});
  dut.Finish();
  const cv::Mat image = Decoded(dut);
  EXPECT_EQ(image.cols, 200);
  EXPECT_LT(image.at<cv::Vec3b>(40, 80)[1], 200);
  EXPECT_GT(image.at<cv::Vec3b>(40, 120)[1], 200);
}

TEST(SeePage, TheLegendBelowNamesWhatWasDrawnAndNothingElse) {
  SeePage dut = PageOf(640, 480);
  dut.Line(kEdge, 0, {0, 0}, {100, 100});
  dut.Finish();
  std::vector<std::string> legend;
  for (const auto& shape : dut.drawing().shapes())
    if (const auto* text = std::get_if<drawing::Text>(&shape.form)) {
      legend.push_back(text->text);
      EXPECT_GE(text->box().y, 480);
      EXPECT_LE(text->box().bottom(), dut.drawing().height());
    }
  EXPECT_THAT(legend, testing::ElementsAre("an edge"));
}

TEST(SeePage, AnImageWithoutAnythingHasNoLegend) {
  SeePage dut = PageOf(64, 48);
  dut.Finish();
  EXPECT_EQ(Decoded(dut).rows, 48);
}

TEST(SeePage, LabelsDoNotOverlapAndStayInTheImages) {
  SeePage dut = PageOf(320, 240);
  dut.Ring(kCorner, 0, {10, 10}, 3);
  for (int i = 0; i < 8; ++i) dut.Label(0, {5, 5}, std::to_string(i), {0xffffff});
  dut.Finish();
  std::vector<drawing::Box> boxes;
  for (const auto& shape : dut.drawing().shapes())
    if (const auto* text = std::get_if<drawing::Text>(&shape.form); text && shape.layer->id == "label")
      boxes.push_back(text->box());
  ASSERT_EQ(boxes.size(), 8u);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_TRUE((drawing::Box{0, 0, 320, 240}).Holds(boxes[i]));
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].Overlaps(boxes[k]));
  }
}

}  // namespace
}  // namespace priamos::head
