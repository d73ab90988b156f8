#include "head/images/grey_depth.hpp"

#include <algorithm>
#include <bit>
#include <opencv2/core.hpp>

namespace priamos::head {
namespace {

constexpr int kNoWhite = 65535;  ///< what a file of 16 bits names that does not know its white

/// Of so many pixels at most may one be brighter than white: a pixel of the sensor that is broken.
constexpr std::size_t kPixelsPerBroken = 10000;

/// The largest value of an image, but for those of broken pixels.
int BrightestOf(const cv::Mat& grey) {
  std::vector<std::size_t> count(kNoWhite + 1);
  for (int v = 0; v < grey.rows; ++v)
    for (int u = 0; u < grey.cols; ++u) ++count[grey.at<std::uint16_t>(v, u)];
  int value = kNoWhite;
  for (std::size_t left = grey.total() / kPixelsPerBroken; value > 0 && count[value] <= left; --value)
    left -= count[value];
  return value;
}

/// The even number of bits, 8 to 16, that `value` takes.
int BitsOf(int value) {
  const int bits = std::bit_width(static_cast<unsigned>(value));
  return std::max(8, (bits + 1) / 2 * 2);
}

int BitsInUse(std::span<const DecodedImage> images) {
  int bits = 8;
  for (const DecodedImage& image : images)
    if (image.grey.depth() == CV_16U)
      bits = std::max(bits, BitsOf(image.white == kNoWhite ? BrightestOf(image.grey) : image.white));
  return bits;
}

/// White as 255. Files of 8 bits have it as they are, unless they name another.
cv::Mat Scaled(const DecodedImage& image, int bits) {
  const bool is_deep = image.grey.depth() == CV_16U;
  const int white = is_deep && image.white == kNoWhite ? (1 << bits) - 1 : image.white;
  if (!is_deep && white == 255) return image.grey;
  cv::Mat grey;
  image.grey.convertTo(grey, CV_8U, 255.0 / white);
  return grey;
}

}  // namespace

ScaledImages ScaleToBytes(std::span<const DecodedImage> images) {
  ScaledImages scaled;
  scaled.bits = BitsInUse(images);
  for (const DecodedImage& image : images) scaled.grey.push_back(Scaled(image, scaled.bits));
  return scaled;
}

}  // namespace priamos::head
