#include "head/images/bmp_image.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

TEST(DecodeBmp, PaletteAndColoursAreRead) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
    const cv::Mat picture = Picture(33, 20, type);
    const auto dut = DecodeBmp(Encode(picture, ".bmp"), {});
    ASSERT_TRUE(dut) << dut.reason();
    cv::Mat expected = picture;
    if (type != CV_8UC1)
      cv::cvtColor(picture, expected, type == CV_8UC3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
    EXPECT_EQ(Difference(dut->grey, expected), 0) << type;
  }
}

TEST(DecodeBmp, WhereverItIsCutOffItIsRefused) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const auto bytes = Encode(Picture(32, 20, type), ".bmp");
    for (std::size_t size = 2; size < bytes.size(); ++size)
      ASSERT_FALSE(DecodeBmp(FileBytes(bytes).first(size), {})) << size << " of " << bytes.size();
  }
}

TEST(DecodeBmp, OtherKindsAndEnormousOnesAreRefused) {
  auto bytes = Encode(Picture(32, 20), ".bmp");
  auto packed = bytes;
  packed[30] = 1;
  EXPECT_THAT(DecodeBmp(packed, {}).reason(), HasSubstr("got 8 bits, kind 1"));
  auto large = bytes;
  large[20] = large[24] = 0x7f;
  EXPECT_THAT(DecodeBmp(large, {}).reason(), HasSubstr("megapixels"));
  auto far = bytes;
  far[13] = 0x80;
  EXPECT_THAT(DecodeBmp(far, {}).reason(), HasSubstr("cut off"));
  auto no_palette = bytes;
  no_palette[17] = 0x7f;
  EXPECT_THAT(DecodeBmp(no_palette, {}).reason(), HasSubstr("palette"));
}

}  // namespace
}  // namespace priamos::head
