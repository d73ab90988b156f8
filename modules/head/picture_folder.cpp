#include "head/picture_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "common/archive.hpp"
#include "common/replace_file.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/files/image_file.hpp"

namespace priamos::head {
namespace {

constexpr unsigned kMode = 0644;

}  // namespace

bool PictureFolder::Has(const FrameNotice& frame) const {
  std::error_code error;
  return std::filesystem::is_regular_file(FileOf(frame), error);
}

std::filesystem::path PictureFolder::FileOf(const FrameNotice& frame) const {
  return folder_ / fmt::format("{}-{}.pgm", ToUtime(frame.exposure),
                               kCameraNames[std::clamp(frame.camera, 0, kCameras - 1)]);
}

std::optional<Refusal> PictureFolder::Keep(const FrameNotice& frame, const GreyImage& image) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) return Refusal{fmt::format("{}: cannot be made: {}", folder_.string(), error.message())};
  std::string content = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
  content.append(image.pixels.begin(), image.pixels.end());
  const std::string file = FileOf(frame);
  if (ReplaceFile(file, content, false, kMode)) return std::nullopt;
  return Refusal{fmt::format("{}: cannot be written: {}", file, std::strerror(errno))};
}

Outcome<GreyImage> PictureFolder::Read(const FrameNotice& frame) const {
  const std::string file = FileOf(frame);
  try {
    std::string notes;
    GreyImage image = ReadImage(file, notes);
    if (image.width == frame.width && image.height == frame.height) return image;
    return Refusal{fmt::format("{}: expected {} x {} pixels as its message says, got {} x {}", file,
                               frame.width, frame.height, image.width, image.height)};
  } catch (const ConfigError& error) {
    return Refusal{error.what()};
  }
}

}  // namespace priamos::head
