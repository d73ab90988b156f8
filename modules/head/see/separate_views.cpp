#include "head/see/separate_views.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/config.hpp"
#include "head/core/camera/projection.hpp"

namespace priamos::head {

void RefuseOnePlace(const std::vector<std::string>& files, const std::vector<CameraModel>& cameras) {
  constexpr double kApart_m = 1e-4;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((OpticalCentre(cameras[i]) - OpticalCentre(cameras[j])).norm() < kApart_m)
        throw ConfigError(
            fmt::format("{}: expected cameras at different places, got two at one; say in projection_matrix "
                        "where each stands",
                        fmt::join(files, ", ")));
}

void RefuseSameImage(std::span<const std::string> files, std::span<const cv::Mat> greys) {
  for (std::size_t i = 0; i < greys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (greys[i].size() == greys[j].size() && cv::norm(greys[i], greys[j], cv::NORM_INF) == 0)
        throw ConfigError(fmt::format("{} and {}: expected an image of each camera, got the same image twice",
                                      files[j], files[i]));
}

}  // namespace priamos::head
