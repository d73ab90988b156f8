#include "test/bench/vision/photometry/other_light.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos::bench {

cv::Mat OtherLight::Of(const cv::Mat& image) const {
  cv::Mat out(image.size(), CV_8UC1);
  const double x0 = image.cols / 2.0, y0 = image.rows / 2.0;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double far = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (x0 * x0 + y0 * y0);
      const double light = std::pow(image.at<unsigned char>(y, x) / 255.0, gamma) * (1 - falloff * far);
      out.at<unsigned char>(y, x) =
          static_cast<unsigned char>(std::lround(std::clamp(255 * gain * light + offset, 0.0, 255.0)));
    }
  return out;
}

std::span<const OtherLight> AllLights() {
  static const std::vector<OtherLight> kLights{
      {"as it is"},
      {"gain 0.5", 0.5},
      {"gain 0.7", 0.7},
      {"gain 0.85", 0.85},
      {"gain 1.2", 1.2},
      {"gain 1.5", 1.5},
      {"gain 2", 2},
      {"offset -30", 1, 1, -30},
      {"offset 30", 1, 1, 30},
      {"gamma 0.6", 1, 0.6},
      {"gamma 1.6", 1, 1.6},
      {"half the light in the corners", 1, 1, 0, 0.5},
      {"all: 0.7, gamma 0.8, 15, falloff 0.4", 0.7, 0.8, 15, 0.4},
      {"the first image: gain 0.5", 0.5, 1, 0, 0, true},
      {"the first image: gamma 1.6", 1, 1.6, 0, 0, true},
  };
  return kLights;
}

}  // namespace priamos::bench
