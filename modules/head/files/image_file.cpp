#include "head/files/image_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "common/config.hpp"

namespace priamos::head {

cv::Mat ReadGrey(const std::string& path) {
  if (!std::ifstream(path)) return {};
  return cv::imread(path, cv::IMREAD_GRAYSCALE);
}

GreyImage ReadImage(const std::string& path) {
  const cv::Mat image = ReadGrey(path);
  if (image.empty() || image.cols < 64 || image.rows < 64)
    throw ConfigError(fmt::format("{}: expected an image of at least 64 by 64 pixels, got none", path));
  return {image.cols, image.rows, {image.begin<std::uint8_t>(), image.end<std::uint8_t>()}};
}

}  // namespace priamos::head
