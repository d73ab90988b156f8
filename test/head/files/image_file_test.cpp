#include "head/files/image_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

using testing::AllOf;
using testing::EndsWith;
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
    std::string notes;
    try {
      ReadImage(file, notes);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  /// An image of 16 bits with values up to `brightest`.
  std::string WriteDeep(const std::string& name, int brightest) const {
    cv::Mat image(70, 80, CV_16UC1, cv::Scalar(brightest));
    image.colRange(0, 40).setTo(brightest / 4);
    cv::imwrite(folder_ / name, image);
    return folder_ / name;
  }

  TemporaryFolder folder_;
};

TEST_F(ImageFileTest, AnImageIsReadRowByRow) {
  std::string notes;
  const GreyImage dut = ReadImage(Write("image.png", 80, 70), notes);
  EXPECT_EQ(notes, "");
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
  const ImageFiles dut = ReadImageFiles({folder_ / "colour.png"}, 1);
  ASSERT_EQ(dut.grey[0].type(), CV_8UC1);
  EXPECT_NEAR(dut.grey[0].at<std::uint8_t>(35, 40), 0.587 * 255, 1);  // the share of green in luminance
}

TEST_F(ImageFileTest, AnImageOf64By64PixelsIsLargeEnoughForCalibration) {
  EXPECT_EQ(ReasonOf(Write("just.png", 64, 64)), "");
  for (const auto& [width, height] : {std::pair(63, 64), std::pair(64, 63)}) {
    const std::string file = Write("small.png", width, height);
    EXPECT_EQ(ReasonOf(file),
              fmt::format("{}: expected an image of at least 64x64 pixels, got {}x{}", file, width, height));
    EXPECT_EQ(ReadImageFiles({file}, 63).grey.size(), 1u);
  }
}

TEST_F(ImageFileTest, TwelveBitsOfAPairAreScaledAlikeAndItIsSaid) {
  for (const char* extension : {".png", ".tif", ".pgm"}) {
    const std::string bright = WriteDeep(std::string("bright") + extension, 4000);
    const std::string dark = WriteDeep(std::string("dark") + extension, 800);
    const ImageFiles dut = ReadImageFiles({bright, dark}, 1);
    EXPECT_EQ(dut.grey[0].at<std::uint8_t>(5, 70), 249);
    EXPECT_EQ(dut.grey[1].at<std::uint8_t>(5, 70), 50);
    EXPECT_EQ(dut.note,
              fmt::format("{}, {}: 16 bits a pixel, of which 12 are in use: 4095 is taken for white", bright,
                          dark));
  }
  std::string notes = "before\n";
  const std::string file = WriteDeep("one.png", 1000);
  ReadImage(file, notes);
  EXPECT_EQ(notes,
            "before\n" + file + ": 16 bits a pixel, of which 10 are in use: 1023 is taken for white\n");
}

TEST_F(ImageFileTest, WhatIsNoImageIsNamedInOneLineAndNothingElseIsPrinted) {
  std::ofstream(folder_ / "text.png") << "this is no picture";
  std::ofstream(folder_ / "empty.png");
  const std::string cut = Write("cut.jpg", 200, 200);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  testing::internal::CaptureStderr();
  EXPECT_EQ(ReasonOf(folder_ / "none.png"),
            (folder_ / "none.png").string() + ": expected an image, got none: No such file or directory");
  EXPECT_EQ(ReasonOf(folder_.path()), folder_.path().string() + ": expected an image, got a folder");
  EXPECT_THAT(ReasonOf(folder_ / "text.png"),
              AllOf(HasSubstr("text.png: expected an image"), EndsWith("got none")));
  EXPECT_THAT(ReasonOf(folder_ / "empty.png"), HasSubstr("got an empty file"));
  EXPECT_THAT(ReasonOf("/dev/zero"), EndsWith("got none")) << "it has no end";
  EXPECT_THAT(ReasonOf(cut), AllOf(HasSubstr("cut.jpg: expected a whole JPEG image"), HasSubstr("cut off")));
  EXPECT_THAT(ReasonOf(""), HasSubstr("expected the name of an image"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace priamos::head
