#include "head/images/image_decoder.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

TEST(DecodeImage, TheContentCountsNotTheName) {
  for (const auto& [extension, name] :
       {std::pair(".jpg", "JPEG"), std::pair(".png", "PNG"), std::pair(".tif", "TIFF"),
        std::pair(".pgm", "PGM"), std::pair(".bmp", "BMP")}) {
    const auto bytes = Encode(Picture(64, 64), extension);
    EXPECT_STREQ(NameOfImageKind(bytes), name);
    const auto dut = DecodeImage(bytes, {});
    ASSERT_TRUE(dut) << extension << ": " << dut.reason();
    EXPECT_EQ(dut->grey.size(), cv::Size(64, 64));
  }
}

TEST(DecodeImage, OtherKindsAreNamed) {
  EXPECT_THAT(DecodeImage(BytesOf("RIFF1234WEBPVP8 "), {}).reason(), HasSubstr("got WebP; save it as PNG"));
  EXPECT_THAT(DecodeImage(BytesOf("GIF89a......"), {}).reason(), HasSubstr("got GIF"));
  EXPECT_THAT(DecodeImage(BytesOf(std::string("\0\0\0\x18"
                                              "ftypheic",
                                              12)),
                          {})
                  .reason(),
              HasSubstr("got HEIF"));
  EXPECT_THAT(DecodeImage(BytesOf("hello"), {}).reason(), testing::EndsWith("got none"));
  EXPECT_THAT(DecodeImage({}, {}).reason(), HasSubstr("an empty file"));
}

/// Files of every kind that is read.
std::vector<std::vector<std::uint8_t>> Files() {
  const cv::Mat grey = Picture(48, 40), colours = Picture(48, 40, CV_8UC3), deep = Picture(48, 40, CV_16UC1);
  return {Encode(grey, ".jpg"),
          Encode(colours, ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1}),
          Encode(grey, ".png"),
          Encode(deep, ".png"),
          Encode(deep, ".tif", {cv::IMWRITE_TIFF_COMPRESSION, 1}),
          Encode(colours, ".tif", {cv::IMWRITE_TIFF_COMPRESSION, 5}),
          Encode(colours, ".tif", {cv::IMWRITE_TIFF_COMPRESSION, 8}),
          Encode(colours, ".ppm"),
          Encode(grey, ".bmp")};
}

TEST(DecodeImage, ChangedBytesNeverGiveMoreThanAnImageOrASentence) {
  const auto files = Files();
  const ImageLimits limits{1'000'000};
  rc::check([&] {
    auto bytes = *rc::gen::elementOf(files);
    const auto places = *rc::gen::container<std::vector<std::size_t>>(
        *rc::gen::inRange(1, 6), rc::gen::inRange(std::size_t{0}, bytes.size()));
    for (const std::size_t at : places) bytes[at] = *rc::gen::arbitrary<std::uint8_t>();
    bytes.resize(*rc::gen::element(bytes.size(), *rc::gen::inRange(std::size_t{0}, bytes.size() + 1)));
    const auto dut = DecodeImage(bytes, limits);
    if (!dut) return RC_ASSERT(!dut.reason().empty() && dut.reason().starts_with("expected "));
    RC_ASSERT(dut->grey.total() > 0 && dut->grey.total() <= limits.most_pixels);
    RC_ASSERT(dut->grey.type() == CV_8UC1 || dut->grey.type() == CV_16UC1);
    RC_ASSERT(dut->white > 0 && dut->white <= 65535);
  });
}

}  // namespace
}  // namespace priamos::head
