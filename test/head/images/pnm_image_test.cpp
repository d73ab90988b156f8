#include "head/images/pnm_image.hpp"

#include <gmock/gmock.h>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

Outcome<DecodedImage> Decode(const std::string& text) {
  return DecodePnm(BytesOf(text), {});
}

TEST(DecodePnm, BytesAndTextAreReadAlike) {
  const cv::Mat picture = Picture(31, 17);
  for (const int binary : {0, 1}) {
    const auto dut = DecodePnm(Encode(picture, ".pgm", {cv::IMWRITE_PXM_BINARY, binary}), {});
    ASSERT_TRUE(dut) << dut.reason();
    EXPECT_EQ(Difference(dut->grey, picture), 0);
    EXPECT_EQ(dut->white, 255);
  }
}

TEST(DecodePnm, TwoBytesAreTheLargerOneFirst) {
  const auto dut = Decode(std::string("P5 # a camera of 12 bits\n2 1\n4095\n\x01\x02\x0f\xff", 38));
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->white, 4095);
  EXPECT_EQ(dut->grey.at<std::uint16_t>(0, 0), 0x0102);
  EXPECT_EQ(dut->grey.at<std::uint16_t>(0, 1), 4095);
}

TEST(DecodePnm, ColoursBecomeGrey) {
  const auto dut = Decode("P3 1 1 100  0 100 0");
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->white, 100);
  EXPECT_EQ(dut->grey.at<std::uint8_t>(0, 0), 59);
}

TEST(DecodePnm, WhereverItIsCutOffItIsRefused) {
  for (const char* extension : {".pgm", ".ppm"})
    for (const int binary : {0, 1}) {
      const cv::Mat picture = Picture(40, 30, extension[2] == 'g' ? CV_8UC1 : CV_8UC3);
      auto bytes = Encode(picture, extension, {cv::IMWRITE_PXM_BINARY, binary});
      // Of a text, blanks at the end may be missing, and a cut number is a number.
      const std::size_t whole = binary == 1 ? bytes.size() : bytes.size() - 8;
      for (std::size_t size = 2; size < whole; ++size)
        ASSERT_FALSE(DecodePnm(FileBytes(bytes).first(size), {})) << size << " of " << bytes.size();
    }
}

TEST(DecodePnm, WhatIsNoHeaderIsRefused) {
  for (const char* text : {"P5", "P5 2", "P5 2 2", "P5 2 2 0 1234", "P5 2 2 70000 12341234",
                           "P5 two 2 255 1234", "P5 99999999999999999999 2 255 1234", "P5 -2 2 255 1234"})
    EXPECT_THAT(Decode(text).reason(), HasSubstr("without width, height and largest value")) << text;
  EXPECT_THAT(Decode("P5 0 2 255 ").reason(), HasSubstr("0x2"));
  EXPECT_THAT(Decode("P5 99999 99999 255 ").reason(), HasSubstr("megapixels"));
  EXPECT_THAT(Decode("P2 2 1 255 10 256").reason(), HasSubstr("values of 0 to 255"));
  EXPECT_THAT(Decode("P2 2 1 255 10 ten").reason(), HasSubstr("values of 0 to 255"));
}

}  // namespace
}  // namespace priamos::head
