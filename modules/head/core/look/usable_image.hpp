#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "common/frame_store.hpp"

namespace priamos::head {

/// Whether there is a picture, and it is large enough for the edge operator.
inline bool IsUsable(const std::optional<GreyImage>& image) {
  constexpr int kSmallest_px = 64;
  return image && image->width >= kSmallest_px && image->height >= kSmallest_px;
}

/// OpenCV's view of the pixels, which the edge operator only reads.
inline cv::Mat Wrap(const GreyImage& image) {
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())};
}

}  // namespace priamos::head
