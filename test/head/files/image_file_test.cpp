#include "head/files/image_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

class ImageFileTest : public testing::Test {
 protected:
  /// Every pixel tells its place.
  std::string Write(const std::string& name, int width, int height) const {
    cv::Mat image(height, width, CV_8UC1);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = Value(u, v);
    cv::imwrite(folder_ / name, image);
    return folder_ / name;
  }
  static std::uint8_t Value(int u, int v) { return static_cast<std::uint8_t>(2 * u + 5 * v); }
  static std::string ReasonOf(const std::string& file) {
    try {
      ReadImage(file);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(ImageFileTest, AnImageIsReadRowByRow) {
  const GreyImage dut = ReadImage(Write("image.png", 80, 70));
  EXPECT_EQ(dut.width, 80);
  EXPECT_EQ(dut.height, 70);
  ASSERT_EQ(dut.pixels.size(), 80u * 70u);
  int wrong = 0;
  for (int v = 0; v < 70; ++v)
    for (int u = 0; u < 80; ++u) wrong += dut.pixels[v * 80 + u] != Value(u, v);
  EXPECT_EQ(wrong, 0);
}

TEST_F(ImageFileTest, ColoursBecomeGrey) {
  cv::imwrite(folder_ / "colour.png", cv::Mat(70, 80, CV_8UC3, cv::Scalar(0, 255, 0)));
  const cv::Mat dut = ReadGrey(folder_ / "colour.png");
  ASSERT_EQ(dut.type(), CV_8UC1);
  EXPECT_NEAR(dut.at<std::uint8_t>(35, 40), 0.587 * 255, 1);  // the share of green in luminance
}

TEST_F(ImageFileTest, WhatIsNoImageIsEmptyAndOpenCvIsSilent) {
  testing::internal::CaptureStderr();
  EXPECT_TRUE(ReadGrey(folder_ / "none.png").empty());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  std::ofstream(folder_ / "text.png") << "this is no picture";
  EXPECT_TRUE(ReadGrey(folder_ / "text.png").empty());
}

TEST_F(ImageFileTest, AnImageOf64By64PixelsIsLargeEnough) {
  EXPECT_EQ(ReasonOf(Write("just.png", 64, 64)), "");
  for (const auto& [width, height] : {std::pair(63, 64), std::pair(64, 63)}) {
    const std::string file = Write("small.png", width, height);
    EXPECT_EQ(ReasonOf(file), file + ": expected an image of at least 64 by 64 pixels, got none");
    EXPECT_FALSE(ReadGrey(file).empty()) << "of any size";
  }
}

TEST_F(ImageFileTest, AFileThatIsNotThereIsNamed) {
  EXPECT_THAT(ReasonOf(folder_ / "none.png"), HasSubstr("none.png: expected an image"));
}

}  // namespace
}  // namespace priamos::head
