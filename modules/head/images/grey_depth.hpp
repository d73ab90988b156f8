#pragma once

#include <span>
#include <vector>

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Images of 8 bits, and how they were made.
struct ScaledImages {
  std::vector<cv::Mat> grey;  ///< CV_8UC1
  int bits = 8;               ///< in use in images of 16 bits: 2^bits - 1 was taken for white
};

/// Makes images of 8 bits. Cameras put 10, 12 or 14 bits into files of 16, which would look black: the
/// brightest value of all images tells how many bits are in use (8, 10, 12, 14 or 16), one number for all, so
/// that images of one scene stay comparable. A PGM whose header names its white is taken at its word.
ScaledImages ScaleToBytes(std::span<const DecodedImage> images);

}  // namespace priamos::head
