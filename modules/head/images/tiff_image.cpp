#include "head/images/tiff_image.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <opencv2/core.hpp>
#include <vector>

#include "head/images/tiff_stream.hpp"

namespace priamos::head {
namespace {

/// Layout of the first image of a file.
struct Layout {
  std::uint32_t width = 0, height = 0;
  std::uint32_t block_width = 0, block_height = 0;  ///< of a tile, or of a strip
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, planar = PLANARCONFIG_CONTIG;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK, compression = COMPRESSION_NONE, orientation = 1;
  bool is_tiled = false;

  int largest() const { return (1 << bits) - 1; }
};

Refusal TiffDamage(const std::string& how) {
  return {fmt::format("expected a whole TIFF image, got one that is cut off or damaged ({}); fetch it again",
                      how)};
}

Layout ReadLayout(TIFF* tiff) {
  Layout layout;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &layout.samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &layout.format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &layout.planar);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &layout.compression);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &layout.photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &layout.orientation);
  layout.is_tiled = TIFFIsTiled(tiff) != 0;
  layout.block_width = layout.width;
  if (layout.is_tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &layout.block_width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &layout.block_height);
  } else {
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &layout.block_height);
    layout.block_height = std::min(layout.block_height, layout.height);
  }
  return layout;
}

const char* NameOfFormat(std::uint16_t format) {
  switch (format) {
    case SAMPLEFORMAT_UINT:
    case SAMPLEFORMAT_VOID:
      return "whole";
    case SAMPLEFORMAT_INT:
      return "signed";
    case SAMPLEFORMAT_IEEEFP:
      return "floating-point";
    default:
      return "complex";
  }
}

std::optional<Refusal> CheckValues(const Layout& layout) {
  const bool is_whole = layout.format == SAMPLEFORMAT_UINT || layout.format == SAMPLEFORMAT_VOID;
  if (!is_whole || layout.bits < 8 || layout.bits > 16)
    return Refusal{
        fmt::format("expected whole values of 8 to 16 bits, got {} values of {} bits; convert it to "
                    "16 bits",
                    NameOfFormat(layout.format), layout.bits)};
  const bool is_grey =
      layout.photometric == PHOTOMETRIC_MINISBLACK || layout.photometric == PHOTOMETRIC_MINISWHITE;
  const bool is_palette =
      layout.photometric == PHOTOMETRIC_PALETTE && layout.bits == 8 && layout.samples == 1;
  const bool is_rgb = layout.photometric == PHOTOMETRIC_RGB && (layout.samples == 3 || layout.samples == 4);
  if (!(is_grey && (layout.samples == 1 || layout.samples == 2)) && !is_palette && !is_rgb)
    return Refusal{
        fmt::format("expected grey values, a palette or colours (RGB), got {} samples of kind {}; "
                    "save it as grey or RGB",
                    layout.samples, layout.photometric)};
  if (layout.planar != PLANARCONFIG_CONTIG && layout.samples > 1)
    return Refusal{"expected the colours of a pixel side by side, got a plane of each; save it as PNG"};
  return std::nullopt;
}

std::optional<Refusal> CheckLayout(const Layout& layout, const ImageLimits& limits) {
  if (auto refusal = CheckImageSize(layout.width, layout.height, limits)) return refusal;
  if (auto refusal = CheckValues(layout)) return refusal;
  const std::uint16_t kind = layout.compression;
  if (kind != COMPRESSION_NONE && kind != COMPRESSION_LZW && kind != COMPRESSION_ADOBE_DEFLATE &&
      kind != COMPRESSION_DEFLATE && kind != COMPRESSION_PACKBITS)
    return Refusal{
        fmt::format("expected TIFF without compression or with LZW, Deflate or PackBits, got kind {}; "
                    "save it as PNG",
                    kind)};
  if (auto refusal = CheckImageSize(layout.block_width, layout.block_height, limits))
    return TiffDamage("its strips or tiles are larger than an image may be");
  return std::nullopt;
}

/// Values of a row of a block, packed without gaps, into 16 bits each; values of 16 bits are in the order of
/// this machine.
void Unpack(const std::uint8_t* row, int bits, std::span<std::uint16_t> values) {
  if (bits == 16) return void(std::memcpy(values.data(), row, values.size_bytes()));
  std::uint32_t rest = 0;
  int left = 0;
  for (std::uint16_t& value : values) {
    for (; left < bits; left += 8) rest = rest << 8 | *row++;
    left -= bits;
    value = static_cast<std::uint16_t>(rest >> left & ((1u << bits) - 1));
  }
}

/// Copies the part of a block at (x, y) that lies in the image.
void Place(const std::vector<std::uint8_t>& block, std::uint32_t x, std::uint32_t y, const Layout& layout,
           cv::Mat& samples) {
  const std::size_t in_block = std::size_t{layout.block_width} * layout.samples;
  const std::size_t row_bytes = (in_block * layout.bits + 7) / 8;
  const std::size_t wanted = std::size_t{std::min(layout.block_width, layout.width - x)} * layout.samples;
  for (std::uint32_t v = y; v < std::min(y + layout.block_height, layout.height); ++v)
    Unpack(&block[(v - y) * row_bytes], layout.bits,
           {samples.ptr<std::uint16_t>(static_cast<int>(v)) + std::size_t{x} * layout.samples, wanted});
}

/// Reads the block at (x, y) as a whole; false where the file has less.
bool ReadBlock(TIFF* tiff, const Layout& layout, std::uint32_t x, std::uint32_t y,
               std::vector<std::uint8_t>& block) {
  const std::uint32_t rows =
      layout.is_tiled ? layout.block_height : std::min(layout.block_height, layout.height - y);
  const std::size_t row_bytes = (std::size_t{layout.block_width} * layout.samples * layout.bits + 7) / 8;
  const auto size = static_cast<tmsize_t>(rows * row_bytes);
  block.resize(static_cast<std::size_t>(size));
  const tmsize_t got = layout.is_tiled
                           ? TIFFReadEncodedTile(tiff, TIFFComputeTile(tiff, x, y, 0, 0), block.data(), size)
                           : TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, y, 0), block.data(), size);
  return got == size;
}

bool ReadSamples(TIFF* tiff, const Layout& layout, cv::Mat& samples) {
  std::vector<std::uint8_t> block;
  for (std::uint32_t y = 0; y < layout.height; y += layout.block_height)
    for (std::uint32_t x = 0; x < layout.width; x += layout.block_width) {
      if (!ReadBlock(tiff, layout, x, y, block)) return false;
      Place(block, x, y, layout, samples);
    }
  return true;
}

/// Colours of 16 bits of a palette's numbers.
Outcome<cv::Mat> ColoursOf(TIFF* tiff, const cv::Mat& numbers) {
  std::array<std::uint16_t*, 3> palette{};
  if (TIFFGetField(tiff, TIFFTAG_COLORMAP, &palette[0], &palette[1], &palette[2]) == 0)
    return TiffDamage("it has no palette");
  cv::Mat colours(numbers.size(), CV_16UC3);
  for (int v = 0; v < numbers.rows; ++v)
    for (int u = 0; u < numbers.cols; ++u)
      for (int c = 0; c < 3; ++c)
        colours.at<cv::Vec3w>(v, u)[c] = palette[c][numbers.at<std::uint16_t>(v, u)];
  colours.convertTo(colours, CV_8U, 1.0 / 257);
  return colours;
}

Outcome<DecodedImage> ToGrey(TIFF* tiff, const Layout& layout, cv::Mat samples) {
  if (layout.photometric == PHOTOMETRIC_PALETTE) {
    const auto colours = ColoursOf(tiff, samples);
    if (!colours) return Refusal{colours.reason()};
    samples = *colours;
  } else if (layout.bits == 8) {
    samples.convertTo(samples, CV_8U);
  } else if (layout.bits < 16 && layout.samples % 2 == 0) {
    return Refusal{fmt::format("expected 8 or 16 bits of an image with transparency, got {}", layout.bits)};
  }
  const auto grey = GreyOfSamples(samples);
  if (!grey) return Refusal{grey.reason()};
  cv::Mat upright = TurnUpright(*grey, layout.orientation);
  if (layout.photometric == PHOTOMETRIC_MINISWHITE) upright = layout.largest() - upright;
  return DecodedImage{upright, layout.photometric == PHOTOMETRIC_PALETTE ? 255 : layout.largest()};
}

}  // namespace

Outcome<DecodedImage> DecodeTiff(FileBytes file, const ImageLimits& limits) {
  // Four samples of two bytes, and what a directory takes.
  const TiffStream stream(file, 8 * limits.most_pixels + (1 << 20));
  if (stream.tiff() == nullptr || !stream.error().empty()) return TiffDamage(stream.error());
  const Layout layout = ReadLayout(stream.tiff());
  if (const auto refusal = CheckLayout(layout, limits)) return *refusal;
  cv::Mat samples(static_cast<int>(layout.height), static_cast<int>(layout.width), CV_16UC(layout.samples));
  if (!ReadSamples(stream.tiff(), layout, samples) || !stream.error().empty())
    return TiffDamage(stream.error().empty() ? "a strip is too short" : stream.error());
  return ToGrey(stream.tiff(), layout, samples);
}

}  // namespace priamos::head
