#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "common/frame_store.hpp"

namespace priamos::head {

/// An image file as grey values; empty for what cannot be read or is no image. A file that is not there never
/// reaches OpenCV, which would print its own message on standard error.
cv::Mat ReadGrey(const std::string& path);

/// An image file as grey values. Throws ConfigError for what is no image of at least 64 by 64 pixels.
GreyImage ReadImage(const std::string& path);

}  // namespace priamos::head
