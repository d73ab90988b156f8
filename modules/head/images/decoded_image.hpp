#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "common/outcome.hpp"

namespace priamos::head {

/// The content of a file.
using FileBytes = std::span<const std::uint8_t>;

/// What a decoder may spend. The size stands in the header of a file, so a small file that would unpack to
/// gigabytes is refused before anything is unpacked.
struct ImageLimits {
  std::size_t most_pixels = 100'000'000;
};

/// Grey values as a file holds them.
struct DecodedImage {
  cv::Mat grey;     ///< CV_8UC1 or CV_16UC1
  int white = 255;  ///< the largest value that the file has room for, 1 to 65535
};

/// Refuses an image without pixels and one with more than `limits` allow.
std::optional<Refusal> CheckImageSize(std::int64_t width, std::int64_t height, const ImageLimits& limits);

/// Luminance of samples of 8 or 16 bits: grey, grey and opacity, red-green-blue, or these and opacity (1 to 4
/// channels). Refuses an image through which one can see: which grey values are behind is not known.
Outcome<cv::Mat> GreyOfSamples(const cv::Mat& samples);

/// Turns an image that a camera held askew has stored: `orientation` is the value of the tag of that name in
/// EXIF and TIFF, 1 to 8; anything else leaves the image as it is.
cv::Mat TurnUpright(const cv::Mat& image, int orientation);

}  // namespace priamos::head
