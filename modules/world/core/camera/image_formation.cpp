#include "world/core/camera/image_formation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "world/core/camera/defocus.hpp"
#include "world/core/camera/normal_table.hpp"

namespace priamos::world {

namespace {

constexpr double kNominalExposure_s = 0.010;
constexpr double kCornerRadius2 = 0.36;  // (480 px / 800 px)^2

/// Functions of the distorted radius, tabulated over its square: how far to stretch to undo the distortion,
/// and how much light is left.
class LensTable {
 public:
  LensTable(const TrueCamera& camera, double vignetting) {
    const double loss = (1 / std::sqrt(1 - vignetting) - 1) / kCornerRadius2;
    const double largest = 2 * std::max(kImageWidth_px, kImageHeight_px) / camera.focal_px;
    step_ = largest * largest / (kEntries - 2);
    for (int i = 0; i < kEntries; ++i) {
      const double r2 = i * step_, r = std::sqrt(r2);
      const Eigen::Vector2d from = camera.centre_px + Eigen::Vector2d(r * camera.focal_px, 0);
      const double undistorted = (camera.UndistortRadially(from) - camera.centre_px).norm();
      stretch_[i] = r > 0 ? undistorted / (r * camera.focal_px) : 1;
      light_[i] = 1 / ((1 + loss * r2) * (1 + loss * r2));
    }
  }
  double Stretch(double r2) const { return Interpolate(stretch_, r2); }
  double Light(double r2) const { return Interpolate(light_, r2); }

 private:
  static constexpr int kEntries = 4096;
  double Interpolate(const std::array<double, kEntries>& table, double r2) const {
    const double place = std::min(r2 / step_, kEntries - 2.0);
    const int i = static_cast<int>(place);
    return table[i] + (place - i) * (table[i + 1] - table[i]);
  }
  double step_;
  std::array<double, kEntries> stretch_, light_;
};

float Bilinear(const cv::Mat& image, double x, double y) {
  x = std::clamp(x, 0.0, image.cols - 1.001);
  y = std::clamp(y, 0.0, image.rows - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float a = float(x - i), b = float(y - j);
  const float* upper = image.ptr<float>(j) + i;
  const float* lower = image.ptr<float>(j + 1) + i;
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

GreyImage FormImage(const ImagingConfig& config, const TrueCamera& camera, double defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng) {
  return FormImage(config, camera, cv::Mat(1, 1, CV_64F, cv::Scalar(defocus_px)), light, exposure, rng);
}

GreyImage FormImage(const ImagingConfig& config, const TrueCamera& camera, const cv::Mat& defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng) {
  cv::Mat sigma_px = defocus_px.clone();
  for (double& sigma : cv::Mat_<double>(sigma_px)) sigma = std::hypot(config.blur_px, sigma);
  const cv::Mat blurred = Blurred(light, sigma_px);

  const LensTable lens(camera, config.vignetting);
  const bool tangential = camera.p1 != 0 || camera.p2 != 0;  // no longer a function of the radius alone
  const double scale =
      (config.white_level - config.black_level) * exposure.gain * exposure.exposure_s / kNominalExposure_s;
  const double read_variance = exposure.gain * exposure.gain * config.read_noise * config.read_noise;
  NormalTable normal(rng);
  GreyImage image{kImageWidth_px, kImageHeight_px, {}};
  image.pixels.reserve(std::size_t(kImageWidth_px) * kImageHeight_px);
  for (int v = 0; v < kImageHeight_px; ++v) {
    for (int u = 0; u < kImageWidth_px; ++u) {
      const Eigen::Vector2d from_centre = Eigen::Vector2d(u, v) - camera.centre_px;
      const double r2 = from_centre.squaredNorm() / (camera.focal_px * camera.focal_px);
      const Eigen::Vector2d cell = FineGrid::FromImage(
          tangential ? camera.Undistort({u, v}) : camera.centre_px + from_centre * lens.Stretch(r2));
      const double signal = scale * lens.Light(r2) * Bilinear(blurred, cell.x() - 0.5, cell.y() - 0.5);
      const double variance = read_variance + exposure.gain * config.photon_noise * signal;
      image.pixels.push_back(ToGrey(config.black_level + signal + std::sqrt(variance) * normal.Draw()));
    }
  }
  return image;
}

}  // namespace priamos::world
