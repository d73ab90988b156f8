#include "head/locate/eyes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/config.hpp"
#include "common/input/regular_file.hpp"
#include "head/core/edges/equal_contrast.hpp"
#include "head/files/camera_file.hpp"
#include "head/files/image_file.hpp"
#include "head/see/separate_views.hpp"

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 32;

/// The call itself is wrong then; two cameras that deliver the same image spoil one moment.
void RefuseNameTwice(const std::vector<std::string>& names) {
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw ConfigError(
          fmt::format("{}: expected an image of each camera, got the same file twice in one moment", *name));
}

}  // namespace

std::optional<Refusal> Eyes::Read(const std::vector<std::string>& names) {
  RefuseNameTwice(names);
  for (const std::string& name : names)
    if (const RegularFile file(name); !file.open())
      return Refusal{fmt::format("{}: expected an image, got {}", name, file.problem())};
  try {
    greys_ = ReadImageFiles(names, kSmallest_px).grey;
    RefuseSameImage(names, greys_);
  } catch (const ConfigError& error) {
    return Refusal{error.what()};
  }
  if (cameras_.empty()) cameras_ = Cameras(names);
  for (std::size_t i = 0; i < n_; ++i)
    if (greys_[i].size() != size_)
      return Refusal{fmt::format("{}: expected {}x{} pixels as the first image has, got {}x{}", names[i],
                                 size_.width, size_.height, greys_[i].cols, greys_[i].rows)};
  return std::nullopt;
}

std::span<const CameraView> Eyes::Look() {
  const auto contrast = ForOneScene(greys_, {});
  edges_.clear();
  for (std::size_t i = 0; i < n_; ++i) edges_.push_back(EdgesOfPhotograph(greys_[i], contrast[i]));
  views_.clear();
  for (std::size_t i = 0; i < n_; ++i) {
    views_.push_back(MakeView(cameras_[i], edges_[i].edges));
    views_.back().blur_px = edges_[i].MedianBlur();
    views_.back().image = &greys_[i];
  }
  return views_;
}

std::vector<CameraModel> Eyes::Cameras(const std::vector<std::string>& names) {
  size_ = greys_.front().size();
  auto cameras = LoadCameras(files_, n_, {{size_.width, size_.height}, are_rectified_});
  if (cameras.size() != n_)
    throw ConfigError(fmt::format("{}: expected {} cameras, one for each image of a moment, got {}",
                                  names.front(), n_, cameras.size()));
  RefuseOnePlace(files_, cameras);
  return cameras;
}

}  // namespace priamos::head
