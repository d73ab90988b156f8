#include "head/picture_source.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "common/archive.hpp"

namespace priamos::head {

PictureSource::PictureSource(const HeadConfig& config, bus::Context& context)
    : context_(context), cameras_(context.instance() + "-camera") {
  if (!config.pictures.empty()) {
    const std::string folder = context.ResolvePath(config.pictures);
    if (!std::filesystem::is_directory(folder))
      throw ConfigError(
          fmt::format("pictures: expected a folder with the pictures of a log, got {}", folder));
    recorded_.emplace(folder);
  }
  if (!config.keep_pictures.empty()) kept_.emplace(context.ResolvePath(config.keep_pictures));
}

bool PictureSource::WasUsed(const FrameNotice& frame) const {
  return !recorded_ || frame.camera > kRight || recorded_->Has(frame);
}

std::optional<GreyImage> PictureSource::Read(const FrameNotice& frame) {
  if (!recorded_) {
    auto image = cameras_.Read(frame);
    if (image && kept_) Keep(frame, *image);
    return image;
  }
  auto image = recorded_->Read(frame);
  if (image) return std::move(*image);
  context_.Log(bus::Level::kWarning, image.reason());
  return std::nullopt;
}

void PictureSource::Keep(const FrameNotice& frame, const GreyImage& image) {
  const auto refusal = kept_->Keep(frame, image);
  if (refusal && n_not_kept_++ == 0) context_.Log(bus::Level::kWarning, refusal->reason);
}

}  // namespace priamos::head
