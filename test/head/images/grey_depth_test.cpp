#include "head/images/grey_depth.hpp"

#include <gtest/gtest.h>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

/// An image whose values go up to `brightest`.
DecodedImage Deep(int brightest, int white = 65535) {
  cv::Mat grey(100, 100, CV_16UC1, cv::Scalar(brightest / 2));
  grey.rowRange(0, 20).setTo(brightest);
  return {grey, white};
}
int GreyAt(const cv::Mat& image, int v) {
  return image.at<std::uint8_t>(v, 0);
}

TEST(ScaleToBytes, TheBitsInUseAreRoundedUp) {
  for (const auto& [brightest, bits] :
       {std::pair(200, 8), std::pair(255, 8), std::pair(256, 10), std::pair(1023, 10), std::pair(1024, 12),
        std::pair(4095, 12), std::pair(4096, 14), std::pair(16383, 14), std::pair(16384, 16),
        std::pair(65535, 16)}) {
    const ScaledImages dut = ScaleToBytes(std::vector{Deep(brightest)});
    EXPECT_EQ(dut.bits, bits) << brightest;
    ASSERT_EQ(dut.grey[0].type(), CV_8UC1);
    EXPECT_NEAR(GreyAt(dut.grey[0], 0), 255.0 * brightest / ((1 << bits) - 1), 0.51) << brightest;
  }
}

TEST(ScaleToBytes, OneScaleForAllImages) {
  const ScaledImages dut = ScaleToBytes(std::vector{Deep(4000), Deep(1000)});
  EXPECT_EQ(dut.bits, 12);
  EXPECT_NEAR(GreyAt(dut.grey[0], 0), 255.0 * 4000 / 4095, 0.51);
  EXPECT_NEAR(GreyAt(dut.grey[1], 0), 255.0 * 1000 / 4095, 0.51);
}

TEST(ScaleToBytes, ABrokenPixelDoesNotDarkenAnImage) {
  DecodedImage image = Deep(1000);
  image.grey.at<std::uint16_t>(50, 50) = 65535;
  const ScaledImages dut = ScaleToBytes(std::vector{image});
  EXPECT_EQ(dut.bits, 10);
  EXPECT_EQ(GreyAt(dut.grey[0], 0), 249);
  EXPECT_EQ(dut.grey[0].at<std::uint8_t>(50, 50), 255);
}

TEST(ScaleToBytes, AHeaderThatNamesWhiteIsBelieved) {
  EXPECT_NEAR(GreyAt(ScaleToBytes(std::vector{Deep(1000, 4095)}).grey[0], 0), 255.0 * 1000 / 4095, 0.51);
  const DecodedImage of_text{cv::Mat(3, 3, CV_8UC1, cv::Scalar(50)), 100};
  EXPECT_NEAR(GreyAt(ScaleToBytes(std::vector{of_text}).grey[0], 0), 127.5, 0.51);
}

TEST(ScaleToBytes, EightBitsStayAsTheyAre) {
  const DecodedImage image{Picture(20, 20), 255};
  EXPECT_EQ(Difference(ScaleToBytes(std::vector{image}).grey[0], image.grey), 0);
}

TEST(ScaleToBytes, ABlackImageStaysBlack) {
  EXPECT_EQ(cv::countNonZero(ScaleToBytes(std::vector{Deep(0)}).grey[0]), 0);
}

}  // namespace
}  // namespace priamos::head
