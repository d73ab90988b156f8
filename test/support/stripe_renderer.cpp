#include "test/support/stripe_renderer.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace priamos::support {
namespace {

/// The signed distance from the plane of light at the board's point behind a pixel; infinite where the board
/// is not seen.
class LightPlane {
 public:
  explicit LightPlane(const StripeScene& scene)
      : scene_(scene), inverse_(scene.camera.image_from_base.leftCols<3>().inverse()) {
    eye_ = -inverse_ * scene.camera.image_from_base.col(3);
  }
  double DistanceAt(double u, double v) const {
    const Eigen::Vector3d ray = inverse_ * scene_.camera.Undistort({u, v}).homogeneous();
    const double travel = -scene_.board.signedDistance(eye_) / scene_.board.normal().dot(ray);
    if (!(travel > 0)) return std::numeric_limits<double>::infinity();
    return scene_.laser.signedDistance(eye_ + travel * ray);
  }

 private:
  const StripeScene& scene_;
  Eigen::Matrix3d inverse_;
  Eigen::Vector3d eye_;
};

/// The line in one column.
void AddLight(const StripeScene& scene, int u, cv::Mat& grey) {
  const LightPlane light(scene);
  const double sigma = scene.thickness_m / 2, row = StripeRow(scene, u);
  if (std::isnan(row)) return;
  const double m_per_px = std::abs(light.DistanceAt(u, row + 0.5) - light.DistanceAt(u, row - 0.5));
  const double reach = 5 * sigma / m_per_px + 2;
  const int first = std::max(0, static_cast<int>(row - reach));
  const int last = std::min(scene.height - 1, static_cast<int>(row + reach));
  for (int v = first; v <= last; ++v) {
    double shine = 0;
    for (int i = 0; i < 9; ++i) {
      const double d = light.DistanceAt(u + (i % 3 - 1) / 3.0, v + (i / 3 - 1) / 3.0) / sigma;
      shine += std::exp(-d * d / 2) / 9;
    }
    grey.at<float>(v, u) += static_cast<float>(scene.amplitude * shine);
  }
}

}  // namespace

GreyImage Render(const StripeScene& scene, Rng& rng) {
  cv::Mat grey(scene.height, scene.width, CV_32FC1);
  for (int v = 0; v < scene.height; ++v)
    grey.row(v) = scene.background + scene.slope_per_px * (v - scene.height / 2);
  for (int u = 0; u < scene.width && scene.amplitude != 0; ++u) AddLight(scene, u, grey);
  if (scene.blur_px > 0) cv::GaussianBlur(grey, grey, {}, scene.blur_px);
  GreyImage image{scene.width, scene.height, {}};
  image.pixels.reserve(grey.total());
  for (const float value : cv::Mat_<float>(grey))
    image.pixels.push_back(
        static_cast<std::uint8_t>(std::clamp(std::lround(value + rng.Normal(scene.noise)), 0L, 255L)));
  return image;
}

double StripeRow(const StripeScene& scene, double u) {
  const LightPlane light(scene);
  double low = 0, high = scene.height - 1;
  const bool rising = light.DistanceAt(u, high) > 0;
  if ((light.DistanceAt(u, low) > 0) == rising) return std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    ((light.DistanceAt(u, middle) > 0) == rising ? high : low) = middle;
  }
  return (low + high) / 2;
}

}  // namespace priamos::support
