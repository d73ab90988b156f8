#include "world/core/camera/image_formation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "world/core/camera/defocus.hpp"
#include "world/core/camera/normal_table.hpp"

namespace priamos::world {

namespace {

constexpr double kNominalExposure_s = 0.010;
/// Light at a pixel, between the four cells of the fine grid around its place.
float Bilinear(const cv::Mat& light, const LensMap::Pixel& at) {
  const float a = at.right, b = at.down;
  const float* upper = light.ptr<float>() + at.cell;
  const float* lower = upper + light.cols;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

std::uint8_t ToGrey(double level) {
  return static_cast<std::uint8_t>(std::clamp(level + 0.5, 0.0, 255.0));
}

}  // namespace

Eigen::Vector2d SubSample(int k, int n) {
  // A row stride that shares no factor with n and is near the golden section spreads the points best.
  int stride = std::max(1, static_cast<int>(std::lround(0.618 * n)));
  while (std::gcd(stride, n) != 1) ++stride;
  // In time the columns must not run along with a motion of the image.
  int shuffle = std::max(1, static_cast<int>(std::lround(0.382 * n)));
  while (std::gcd(shuffle, n) != 1) ++shuffle;
  const int column = k * shuffle % n, row = column * stride % n;
  return {(column + 0.5) / n, (row + 0.5) / n};
}

GreyImage FormImage(const ImagingConfig& config, const LensMap& lens, double defocus_px, const cv::Mat& light,
                    const Exposure& exposure, Rng& rng) {
  return FormImage(config, lens, cv::Mat(1, 1, CV_64F, cv::Scalar(defocus_px)), light, exposure, rng);
}

GreyImage FormImage(const ImagingConfig& config, const LensMap& lens, const cv::Mat& defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng) {
  cv::Mat sigma_px = defocus_px.clone();
  for (double& sigma : cv::Mat_<double>(sigma_px)) sigma = std::hypot(config.blur_px, sigma);
  const cv::Mat blurred = Blurred(light, sigma_px);
  CV_Assert(blurred.isContinuous() && blurred.cols == FineGrid::kWidth && blurred.rows == FineGrid::kHeight);

  const double scale =
      (config.white_level - config.black_level) * exposure.gain * exposure.exposure_s / kNominalExposure_s;
  const double read_variance = exposure.gain * exposure.gain * config.read_noise * config.read_noise;
  NormalTable normal(rng);
  GreyImage image{kImageWidth_px, kImageHeight_px, {}};
  image.pixels.reserve(lens.pixels().size());
  for (const LensMap::Pixel& pixel : lens.pixels()) {
    const double signal = scale * pixel.light * Bilinear(blurred, pixel);
    const double variance = read_variance + exposure.gain * config.photon_noise * signal;
    image.pixels.push_back(ToGrey(config.black_level + signal + std::sqrt(variance) * normal.Draw()));
  }
  return image;
}

}  // namespace priamos::world
