#pragma once

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// A picture of smooth areas, edges and grain: every part of it costs a coder some bytes.
inline cv::Mat Picture(int width, int height, int type = CV_8UC1) {
  cv::Mat picture(height, width, type);
  const int channels = picture.channels();
  for (int v = 0; v < height; ++v)
    for (int i = 0; i < width * channels; ++i) {
      const int u = i / channels;
      const int value =
          (u / 7 + v / 5) % 2 * 90 + 2 * u % 60 + (u * 31 + v * 17 + i % channels * 40) % 11 + 20;
      if (picture.depth() == CV_8U) picture.ptr<std::uint8_t>(v)[i] = static_cast<std::uint8_t>(value);
      if (picture.depth() == CV_16U)
        picture.ptr<std::uint16_t>(v)[i] = static_cast<std::uint16_t>(257 * value);
      if (picture.depth() == CV_32F) picture.ptr<float>(v)[i] = static_cast<float>(value) / 255;
    }
  return picture;
}

/// A file as OpenCV writes it; `extension` with its dot.
inline std::vector<std::uint8_t> Encode(const cv::Mat& picture, const std::string& extension,
                                        const std::vector<int>& parameters = {}) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, picture, bytes, parameters);
  return bytes;
}

inline std::vector<std::uint8_t> BytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

/// The largest difference of two images; -1 for different sizes or depths.
inline double Difference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : -1;
}

}  // namespace priamos::head
