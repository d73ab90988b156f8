#include "head/images/png_image.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

TEST(DecodePng, EveryDepthAndColourIsRead) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3}) {
    const cv::Mat picture = Picture(75, 66, type);
    const auto dut = DecodePng(Encode(picture, ".png"), {});
    ASSERT_TRUE(dut) << dut.reason();
    cv::Mat expected = picture;
    if (picture.channels() == 3) cv::cvtColor(picture, expected, cv::COLOR_BGR2GRAY);
    EXPECT_EQ(Difference(dut->grey, expected), 0) << type;
    EXPECT_EQ(dut->white, picture.depth() == CV_8U ? 255 : 65535);
  }
}

TEST(DecodePng, OneBitIsBlackAndWhite) {
  const cv::Mat picture = Picture(70, 64) > 100;
  const auto dut = DecodePng(Encode(picture, ".png", {cv::IMWRITE_PNG_BILEVEL, 1}), {});
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(Difference(dut->grey, picture), 0);
}

TEST(DecodePng, ATransparentImageIsRefused) {
  cv::Mat picture(64, 64, CV_8UC4, cv::Scalar(10, 20, 30, 255));
  EXPECT_TRUE(DecodePng(Encode(picture, ".png"), {})) << "opaque";
  picture.at<cv::Vec4b>(5, 5)[3] = 0;
  EXPECT_THAT(DecodePng(Encode(picture, ".png"), {}).reason(), HasSubstr("transparent"));
}

TEST(DecodePng, WhereverItIsCutOffItIsRefused) {
  const auto bytes = Encode(Picture(96, 64, CV_8UC3), ".png");
  for (std::size_t size = 8; size < bytes.size(); ++size)
    ASSERT_FALSE(DecodePng(FileBytes(bytes).first(size), {})) << size << " of " << bytes.size();
}

TEST(DecodePng, EveryChangedByteIsNoticed) {
  auto bytes = Encode(Picture(64, 48), ".png");
  for (std::size_t i = 8; i < bytes.size(); ++i) {
    const std::uint8_t bit = 1 << i % 8;
    bytes[i] ^= bit;
    ASSERT_FALSE(DecodePng(bytes, {})) << i;
    bytes[i] ^= bit;
  }
  EXPECT_TRUE(DecodePng(bytes, {}));
}

TEST(DecodePng, AnEnormousImageIsRefusedByItsHeader) {
  const std::vector<std::uint8_t> header{0,    0,    0,    13,   'I',  'H', 'D', 'R', 0,   0,   0xc3,
                                         0x50, 0,    0,    0xc3, 0x50, 8,   0,   0,   0,   0,   0x6e,
                                         0xc4, 0x62, 0x16, 0,    0,    1,   0,   'I', 'D', 'A', 'T'};
  auto bytes = BytesOf("\x89PNG\r\n\x1a\n");
  bytes.insert(bytes.end(), header.begin(), header.end());
  EXPECT_THAT(DecodePng(bytes, {}).reason(), HasSubstr("at most 100 megapixels, got 50000x50000"));
}

}  // namespace
}  // namespace priamos::head
