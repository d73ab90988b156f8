#include "head/images/jpeg_image.hpp"

#include <gmock/gmock.h>

#include <cstdio>
#include <opencv2/imgproc.hpp>

// These need <cstdio> before them.
#include <jpeglib.h>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// `jpeg` with an EXIF block that says how it is to be turned.
std::vector<std::uint8_t> WithOrientation(std::vector<std::uint8_t> jpeg, std::uint8_t orientation) {
  const std::vector<std::uint8_t> exif{0xff, 0xe1, 0,  30, 'E', 'x', 'i', 'f',         0, 0, 'M',
                                       'M',  0,    42, 0,  0,   0,   8,   0,           1, 1, 0x12,
                                       0,    3,    0,  0,  0,   1,   0,   orientation, 0, 0};
  jpeg.insert(jpeg.begin() + 2, exif.begin(), exif.end());
  return jpeg;
}

/// A JPEG of four colours, as a printer has them.
std::vector<std::uint8_t> OfAPrint() {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = jpeg.image_height = 64;
  jpeg.input_components = 4;
  jpeg.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row(4 * 64, 100);
  JSAMPROW rows = row.data();
  while (jpeg.next_scanline < jpeg.image_height) jpeg_write_scanlines(&jpeg, &rows, 1);
  jpeg_finish_compress(&jpeg);
  const std::vector<std::uint8_t> bytes(memory, memory + size);
  jpeg_destroy_compress(&jpeg);
  std::free(memory);
  return bytes;
}

TEST(DecodeJpeg, GreyAndColourAreReadAsOpenCvReadsThem) {
  for (const int type : {CV_8UC1, CV_8UC3})
    for (const int progressive : {0, 1}) {
      const auto bytes = Encode(Picture(97, 61, type), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, progressive});
      const auto dut = DecodeJpeg(bytes, {});
      ASSERT_TRUE(dut) << dut.reason();
      EXPECT_EQ(dut->white, 255);
      EXPECT_EQ(Difference(dut->grey, cv::imdecode(bytes, cv::IMREAD_GRAYSCALE)), 0);
    }
}

TEST(DecodeJpeg, ACameraHeldAskewIsTurned) {
  const cv::Mat picture = Picture(80, 48);
  const auto plain = DecodeJpeg(Encode(picture, ".jpg"), {});
  for (std::uint8_t orientation = 1; orientation <= 8; ++orientation) {
    const auto dut = DecodeJpeg(WithOrientation(Encode(picture, ".jpg"), orientation), {});
    ASSERT_TRUE(dut) << dut.reason();
    EXPECT_EQ(Difference(dut->grey, TurnUpright(plain->grey, orientation)), 0) << int{orientation};
  }
}

TEST(DecodeJpeg, WhereverItIsCutOffItIsRefused) {
  for (const int progressive : {0, 1}) {
    const auto bytes =
        Encode(Picture(96, 64, CV_8UC3), ".jpg",
               {cv::IMWRITE_JPEG_PROGRESSIVE, progressive, cv::IMWRITE_JPEG_RST_INTERVAL, 1 - progressive});
    for (std::size_t size = 3; size < bytes.size(); ++size)
      ASSERT_FALSE(DecodeJpeg(FileBytes(bytes).first(size), {})) << size << " of " << bytes.size();
  }
}

TEST(DecodeJpeg, AnEndMarkBehindHalfAnImageDoesNotHelp) {
  const auto bytes = Encode(Picture(96, 64), ".jpg");
  for (std::size_t size = bytes.size() / 2; size < bytes.size() - 8; ++size) {
    std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    cut.insert(cut.end(), {0xff, 0xd9});
    ASSERT_FALSE(DecodeJpeg(cut, {})) << size;
  }
}

TEST(DecodeJpeg, APartThatIsMissingInTheMiddleIsRefused) {
  const auto bytes = Encode(Picture(160, 120), ".jpg");
  auto gap = bytes;
  gap.erase(gap.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2),
            gap.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2 + 200));
  EXPECT_THAT(DecodeJpeg(gap, {}).reason(), AllOf(HasSubstr("expected a whole JPEG"), HasSubstr("damaged")));
}

TEST(DecodeJpeg, ColoursOfAPrintAreRefused) {
  EXPECT_THAT(DecodeJpeg(OfAPrint(), {}).reason(), HasSubstr("CMYK"));
}

TEST(DecodeJpeg, AnEnormousImageIsRefusedByItsHeader) {
  auto bytes = Encode(Picture(64, 64), ".jpg");
  const std::vector<std::uint8_t> frame{0xff, 0xc0};
  const auto at = std::search(bytes.begin(), bytes.end(), frame.begin(), frame.end());
  for (int i = 5; i < 9; i += 2) at[i] = 0xf0;
  EXPECT_THAT(DecodeJpeg(bytes, {}).reason(), HasSubstr("at most 100 megapixels, got 61504x61504"));
}

TEST(DecodeJpeg, WhatFollowsTheEndIsNotLookedAt) {
  auto bytes = Encode(Picture(64, 64), ".jpg");
  bytes.insert(bytes.end(), 1000, 'x');
  EXPECT_TRUE(DecodeJpeg(bytes, {}));
}

}  // namespace
}  // namespace priamos::head
