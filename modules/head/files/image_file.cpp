#include "head/files/image_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/config.hpp"
#include "head/images/grey_depth.hpp"
#include "head/images/image_decoder.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallestForCalibration_px = 64;
constexpr std::size_t kMagicBytes = 16;
constexpr std::size_t kPartBytes = 1 << 20;

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw ConfigError(fmt::format("{}: {}", path, what));
}

void Append(std::ifstream& file, std::size_t most, std::vector<std::uint8_t>& bytes) {
  const std::size_t before = bytes.size();
  bytes.resize(before + most);
  file.read(reinterpret_cast<char*>(bytes.data() + before), static_cast<std::streamsize>(most));
  bytes.resize(before + static_cast<std::size_t>(file.gcount()));
}

/// The content of a file. Of what is no image by its first bytes nothing more is read: it may have no end.
std::vector<std::uint8_t> BytesOf(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) Fail(path, "expected an image, got a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) Fail(path, fmt::format("expected an image, got none: {}", std::strerror(errno)));
  std::vector<std::uint8_t> bytes;
  Append(file, kMagicBytes, bytes);
  if (NameOfImageKind(bytes) == nullptr) return bytes;
  while (file && bytes.size() <= kMostImageBytes) Append(file, kPartBytes, bytes);
  if (bytes.size() > kMostImageBytes)
    Fail(path, fmt::format("expected an image of at most {} MB, got more", kMostImageBytes >> 20));
  return bytes;
}

DecodedImage Read(const std::string& path, int smallest_px) {
  if (path.empty()) throw ConfigError("\"\": expected the name of an image, got none");
  auto image = DecodeImage(BytesOf(path), {});
  if (!image) Fail(path, image.reason());
  const cv::Mat& grey = image->grey;
  if (grey.cols < smallest_px || grey.rows < smallest_px)
    Fail(path, fmt::format("expected an image of at least {}x{} pixels, got {}x{}", smallest_px, smallest_px,
                           grey.cols, grey.rows));
  return std::move(*image);
}

/// What a person should know of images that were scaled; empty if none was.
std::string NoteOf(const std::vector<std::string>& paths, const std::vector<DecodedImage>& images, int bits) {
  std::vector<std::string> deep;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (images[i].grey.depth() == CV_16U) deep.push_back(paths[i]);
  if (deep.empty()) return "";
  return fmt::format("{}: 16 bits a pixel, of which {} are in use: {} is taken for white",
                     fmt::join(deep, ", "), bits, (1 << bits) - 1);
}

}  // namespace

ImageFiles ReadImageFiles(const std::vector<std::string>& paths, int smallest_px) {
  std::vector<DecodedImage> images;
  images.reserve(paths.size());
  for (const std::string& path : paths) images.push_back(Read(path, smallest_px));
  ScaledImages scaled = ScaleToBytes(images);
  return {std::move(scaled.grey), NoteOf(paths, images, scaled.bits)};
}

GreyImage ReadImage(const std::string& path, std::string& notes) {
  const ImageFiles file = ReadImageFiles({path}, kSmallestForCalibration_px);
  if (!file.note.empty()) notes += file.note + "\n";
  const cv::Mat& grey = file.grey.front();
  return {grey.cols, grey.rows, {grey.begin<std::uint8_t>(), grey.end<std::uint8_t>()}};
}

}  // namespace priamos::head
