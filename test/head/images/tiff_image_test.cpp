#include "head/images/tiff_image.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

constexpr int kNone = 1, kLzw = 5, kDeflate = 8, kPackBits = 32773;

std::vector<std::uint8_t> Tiff(const cv::Mat& picture, int compression = kNone) {
  return Encode(picture, ".tiff", {cv::IMWRITE_TIFF_COMPRESSION, compression});
}

/// Entries of a directory, each a tag and its number, and pixels behind them: a file of one strip.
std::vector<std::uint8_t> Handmade(const std::vector<std::pair<int, int>>& entries,
                                   const std::vector<std::uint8_t>& pixels) {
  std::vector<std::uint8_t> file{'I', 'I', 42, 0, 8, 0, 0, 0};
  const auto add = [&](int value, int bytes) {
    for (int i = 0; i < bytes; ++i) file.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  const int n = static_cast<int>(entries.size()) + 2;
  add(n, 2);
  const auto entry = [&](int tag, int value) {
    add(tag, 2);
    add(4, 2);  // long
    add(1, 4);
    add(value, 4);
  };
  for (const auto& [tag, value] : entries)
    if (tag < 273) entry(tag, value);
  entry(273, 8 + 2 + 12 * n + 4);
  for (const auto& [tag, value] : entries)
    if (tag > 273 && tag < 279) entry(tag, value);
  entry(279, static_cast<int>(pixels.size()));
  for (const auto& [tag, value] : entries)
    if (tag > 279) entry(tag, value);
  add(0, 4);
  file.insert(file.end(), pixels.begin(), pixels.end());
  return file;
}

TEST(DecodeTiff, EveryDepthColourAndCompressionIsRead) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3})
    for (const int compression : {kNone, kLzw, kDeflate, kPackBits}) {
      const cv::Mat picture = Picture(75, 66, type);
      const auto dut = DecodeTiff(Tiff(picture, compression), {});
      ASSERT_TRUE(dut) << dut.reason();
      cv::Mat expected = picture;
      if (picture.channels() == 3) cv::cvtColor(picture, expected, cv::COLOR_BGR2GRAY);
      EXPECT_EQ(Difference(dut->grey, expected), 0) << type << " " << compression;
      EXPECT_EQ(dut->white, picture.depth() == CV_8U ? 255 : 65535);
    }
}

TEST(DecodeTiff, TwelvePackedBitsAreUnpacked) {
  // Two pixels in three bytes: 0x123, 0xfed.
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 4; ++i) pixels.insert(pixels.end(), {0x12, 0x3f, 0xed});
  const auto dut =
      DecodeTiff(Handmade({{256, 4}, {257, 2}, {258, 12}, {259, 1}, {262, 1}, {278, 2}}, pixels), {});
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->white, 4095);
  for (int v = 0; v < 2; ++v)
    for (int u = 0; u < 4; ++u) EXPECT_EQ(dut->grey.at<std::uint16_t>(v, u), u % 2 == 0 ? 0x123 : 0xfed);
}

TEST(DecodeTiff, WhereZeroIsWhiteItIsTurnedRound) {
  const std::vector<std::pair<int, int>> tags{{256, 2}, {257, 2}, {258, 8}, {259, 1}, {262, 0}, {278, 2}};
  const auto dut = DecodeTiff(Handmade(tags, {0, 10, 200, 255}), {});
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(Difference(dut->grey, (cv::Mat_<std::uint8_t>(2, 2) << 255, 245, 55, 0)), 0);
}

TEST(DecodeTiff, AnImageStoredAskewIsTurned) {
  const auto dut = DecodeTiff(
      Handmade({{256, 2}, {257, 2}, {258, 8}, {259, 1}, {262, 1}, {274, 6}, {278, 2}}, {1, 2, 3, 4}), {});
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(Difference(dut->grey, (cv::Mat_<std::uint8_t>(2, 2) << 3, 1, 4, 2)), 0);
}

TEST(DecodeTiff, WhatIsNoGreyValueIsRefusedByName) {
  EXPECT_THAT(DecodeTiff(Tiff(Picture(64, 64, CV_32FC1)), {}).reason(),
              HasSubstr("floating-point values of 32 bits"));
  const auto of = [](int bits, int kind, int format) {
    return DecodeTiff(
               Handmade({{256, 2}, {257, 2}, {258, bits}, {259, 1}, {262, kind}, {278, 2}, {339, format}},
                        std::vector<std::uint8_t>(64)),
               {})
        .reason();
  };
  EXPECT_THAT(of(16, 1, 2), HasSubstr("signed values of 16 bits"));
  EXPECT_THAT(of(32, 1, 1), HasSubstr("whole values of 32 bits"));
  EXPECT_THAT(of(1, 1, 1), HasSubstr("of 1 bits"));
  EXPECT_THAT(of(8, 5, 1), HasSubstr("samples of kind 5"));
}

TEST(DecodeTiff, WhereverItIsCutOffItIsRefused) {
  for (const int compression : {kNone, kLzw, kDeflate, kPackBits}) {
    const auto bytes = Tiff(Picture(64, 48), compression);
    // The last four bytes say that no other image follows.
    for (std::size_t size = 4; size < bytes.size() - 4; ++size)
      ASSERT_FALSE(DecodeTiff(FileBytes(bytes).first(size), {}))
          << compression << ": " << size << " of " << bytes.size();
  }
}

TEST(DecodeTiff, EnormousImagesAndStripsAreRefusedByTheirHeader) {
  const std::vector<std::uint8_t> few(16);
  EXPECT_THAT(
      DecodeTiff(Handmade({{256, 70000}, {257, 70000}, {258, 8}, {259, 1}, {262, 1}, {278, 70000}}, few), {})
          .reason(),
      HasSubstr("at most 100 megapixels, got 70000x70000"));
  EXPECT_NE(
      DecodeTiff(Handmade({{256, 9000}, {257, 9000}, {258, 8}, {259, 1}, {262, 1}, {278, 9000}}, few), {})
          .reason(),
      "");
  EXPECT_NE(
      DecodeTiff(Handmade({{256, 0}, {257, 4}, {258, 8}, {259, 1}, {262, 1}, {278, 4}}, few), {}).reason(),
      "");
}

}  // namespace
}  // namespace priamos::head
