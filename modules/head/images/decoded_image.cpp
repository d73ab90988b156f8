#include "head/images/decoded_image.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

/// Pixels of `opacity` that are not fully opaque.
int CountTransparent(const cv::Mat& opacity) {
  const double opaque = opacity.depth() == CV_8U ? 255 : 65535;
  return static_cast<int>(opacity.total()) - cv::countNonZero(opacity == opaque);
}

cv::Mat Luminance(const cv::Mat& samples) {
  cv::Mat grey;
  switch (samples.channels()) {
    case 1:
      return samples;
    case 2:
      cv::extractChannel(samples, grey, 0);
      break;
    case 3:
      cv::cvtColor(samples, grey, cv::COLOR_RGB2GRAY);
      break;
    default:
      cv::cvtColor(samples, grey, cv::COLOR_RGBA2GRAY);
      break;
  }
  return grey;
}

}  // namespace

std::optional<Refusal> CheckImageSize(std::int64_t width, std::int64_t height, const ImageLimits& limits) {
  if (width <= 0 || height <= 0)
    return Refusal{fmt::format("expected an image with pixels, got {}x{}", width, height)};
  const auto most = static_cast<std::int64_t>(limits.most_pixels);
  if (width > most || height > most || width * height > most)
    return Refusal{fmt::format("expected at most {} megapixels, got {}x{}; make it smaller", most / 1'000'000,
                               width, height)};
  return std::nullopt;
}

Outcome<cv::Mat> GreyOfSamples(const cv::Mat& samples) {
  const int channels = samples.channels();
  if (channels == 2 || channels == 4) {
    cv::Mat opacity;
    cv::extractChannel(samples, opacity, channels - 1);
    if (const int seen_through = CountTransparent(opacity); seen_through > 0)
      return Refusal{fmt::format(
          "expected an opaque image, got {:.3g} % transparent pixels; save it without transparency",
          100.0 * seen_through / static_cast<double>(samples.total()))};
  }
  return Luminance(samples);
}

cv::Mat TurnUpright(const cv::Mat& image, int orientation) {
  if (orientation < 2 || orientation > 8) return image;
  constexpr int kBoth = -1, kLeftRight = 1, kTopBottom = 0;
  cv::Mat turned = image, upright;  // never the same memory: the image is not ours
  if (orientation >= 5) cv::transpose(image, turned);
  switch (orientation) {
    case 2:
    case 6:
      cv::flip(turned, upright, kLeftRight);
      break;
    case 3:
    case 7:
      cv::flip(turned, upright, kBoth);
      break;
    case 4:
    case 8:
      cv::flip(turned, upright, kTopBottom);
      break;
    default:
      return turned;  // 5: transposed alone
  }
  return upright;
}

}  // namespace priamos::head
