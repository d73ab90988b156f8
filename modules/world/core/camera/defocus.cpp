#include "world/core/camera/defocus.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "world/core/camera/fine_grid.hpp"

namespace priamos::world {
namespace {

constexpr int kMostBlurs = 4;
constexpr double kFineEnough_px = 0.2;  // two blurs that differ by less are mixed without loss

cv::Mat Filtered(const cv::Mat& light, double sigma_px) {
  const cv::Mat kernel = PixelKernel(sigma_px);
  cv::Mat blurred;
  cv::sepFilter2D(light, blurred, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return blurred;
}

}  // namespace

cv::Mat PixelKernel(double sigma_px) {
  const double sigma = std::max(FineGrid::kScale * sigma_px, 0.05), half = FineGrid::kScale / 2.0;
  const int reach = static_cast<int>(std::ceil(3.5 * sigma + half));
  cv::Mat kernel(1, 2 * reach + 1, CV_32F);
  const auto below = [sigma](double x) { return 0.5 * std::erfc(-x / (sigma * std::sqrt(2.0))); };
  for (int i = -reach; i <= reach; ++i)
    kernel.at<float>(i + reach) = float(below(i + half) - below(i - half));
  return kernel / cv::sum(kernel)[0];
}

cv::Mat Blurred(const cv::Mat& light, const cv::Mat& sigma_px) {
  double least = 0, most = 0;
  cv::minMaxLoc(sigma_px, &least, &most);
  const int steps =
      std::clamp(static_cast<int>(std::ceil((most - least) / kFineEnough_px)), 0, kMostBlurs - 1);
  if (steps == 0) return Filtered(light, least);
  const double step = (most - least) / steps;
  cv::Mat at, sum = cv::Mat::zeros(light.size(), CV_32F);
  sigma_px.convertTo(at, CV_32F);
  cv::resize(at, at, light.size(), 0, 0, cv::INTER_LINEAR);
  for (int k = 0; k <= steps; ++k) {
    const cv::Mat blurred = Filtered(light, least + k * step);
    // A hat over this blur; the hats of all add up to one.
    const cv::Mat away = cv::abs((at - (least + k * step)) / step);
    const cv::Mat weight = cv::max(1 - away, 0);
    sum += weight.mul(blurred);
  }
  return sum;
}

}  // namespace priamos::world
