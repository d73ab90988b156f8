#include "head/images/bmp_image.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

constexpr std::size_t kFileHeader = 14, kInfoHeader = 40;

struct BmpHeader {
  std::int64_t data = 0;  ///< where the pixels begin
  std::int64_t palette = 0, colours = 0;
  std::int64_t width = 0, height = 0;  ///< negative height: rows from the top
  int bits = 0, compression = 0;

  std::int64_t rows() const { return std::abs(height); }
  std::int64_t row_bytes() const { return (width * bits + 31) / 32 * 4; }
};

std::int64_t Number(FileBytes file, std::size_t at, int bytes) {
  std::uint32_t number = 0;
  for (int i = 0; i < bytes; ++i) number |= std::uint32_t{file[at + i]} << (8 * i);
  return bytes == 4 ? static_cast<std::int32_t>(number) : static_cast<std::int64_t>(number);
}

BmpHeader ReadHeader(FileBytes file) {
  BmpHeader header;
  header.data = Number(file, 10, 4);
  header.palette = static_cast<std::int64_t>(kFileHeader) + Number(file, 14, 4);
  header.width = Number(file, 18, 4);
  header.height = Number(file, 22, 4);
  header.bits = static_cast<int>(Number(file, 28, 2));
  header.compression = static_cast<int>(Number(file, 30, 4));
  header.colours = Number(file, 46, 4);
  if (header.colours == 0) header.colours = 256;
  return header;
}

/// Whether the masks of its colours only say what is usual: blue, green, red.
bool HasUsualMasks(FileBytes file, const BmpHeader& header) {
  constexpr std::size_t kMasks = kFileHeader + kInfoHeader;
  return header.compression == 3 && file.size() >= kMasks + 12 && Number(file, kMasks, 4) == 0xFF0000 &&
         Number(file, kMasks + 4, 4) == 0xFF00 && Number(file, kMasks + 8, 4) == 0xFF;
}

Refusal BmpDamage(const std::string& got) {
  return {fmt::format("expected a whole BMP image, got one {}; fetch it again", got)};
}

/// Red, green and blue of the palette's colours, as one row; those that it has not are black.
cv::Mat PaletteOf(FileBytes file, const BmpHeader& header) {
  cv::Mat grey, palette(1, 256, CV_8UC3, cv::Scalar::all(0));
  for (int i = 0; i < std::min<std::int64_t>(header.colours, 256); ++i) {
    const auto* bgr = &file[header.palette + 4 * i];
    palette.at<cv::Vec3b>(i) = {bgr[2], bgr[1], bgr[0]};
  }
  cv::cvtColor(palette, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

cv::Mat GreyOf(FileBytes file, const BmpHeader& header) {
  const auto row_bytes = static_cast<std::size_t>(header.row_bytes());
  const cv::Mat stored(static_cast<int>(header.rows()), static_cast<int>(header.width),
                       CV_8UC(header.bits / 8), const_cast<std::uint8_t*>(&file[header.data]), row_bytes);
  cv::Mat grey;
  if (header.bits == 8)
    cv::LUT(stored, PaletteOf(file, header), grey);
  else
    cv::cvtColor(stored, grey, header.bits == 24 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  if (header.height > 0) cv::flip(grey, grey, 0);
  return grey;
}

}  // namespace

Outcome<DecodedImage> DecodeBmp(FileBytes file, const ImageLimits& limits) {
  if (file.size() < kFileHeader + kInfoHeader) return BmpDamage("that is cut off in its header");
  const BmpHeader header = ReadHeader(file);
  if (const auto refusal = CheckImageSize(header.width, header.rows(), limits)) return *refusal;
  const bool is_known = header.bits == 8 || header.bits == 24 || header.bits == 32;
  const bool is_plain = header.compression == 0 || (header.bits == 32 && HasUsualMasks(file, header));
  if (!is_known || !is_plain)
    return Refusal{
        fmt::format("expected BMP of 8, 24 or 32 bits without compression, got {} bits, kind {}; "
                    "save it as PNG",
                    header.bits, header.compression)};
  const auto size = static_cast<std::int64_t>(file.size());
  const bool has_palette =
      header.bits != 8 || (header.colours > 0 && header.colours <= 256 && header.palette > 0 &&
                           header.palette + 4 * header.colours <= size);
  if (!has_palette) return BmpDamage("that is damaged: its palette lies outside");
  if (header.data < 0 || header.data + header.rows() * header.row_bytes() > size)
    return BmpDamage(fmt::format("that is cut off: {} of {} bytes", size,
                                 header.data + header.rows() * header.row_bytes()));
  return DecodedImage{GreyOf(file, header), 255};
}

}  // namespace priamos::head
