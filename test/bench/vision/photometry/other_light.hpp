#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

namespace priamos::bench {

/// What another camera, or another exposure, would have made of an image.
struct OtherLight {
  std::string name;
  double gain = 1, gamma = 1, offset = 0;
  double falloff = 0;     ///< share of the light that is lost in the corners
  bool of_first = false;  ///< the first camera sees in it, not the others

  cv::Mat Of(const cv::Mat& image) const;
};

/// The first one changes nothing.
std::span<const OtherLight> AllLights();

}  // namespace priamos::bench
