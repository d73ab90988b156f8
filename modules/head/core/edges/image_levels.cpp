#include "head/core/edges/image_levels.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace priamos::head {

bool Halve(const cv::Mat& image, cv::Mat& half) {
  const cv::Size size(image.cols / 2, image.rows / 2);
  if (std::min(size.width, size.height) < kLeastSide_px) return false;
  cv::resize(image({0, 0, 2 * size.width, 2 * size.height}), half, size, 0, 0, cv::INTER_AREA);
  return true;
}

Eigen::Vector2d ToWhole(const Eigen::Vector2d& at, double factor) {
  return factor * at + Eigen::Vector2d::Constant((factor - 1) / 2);
}

Eigen::Vector2d ToLevel(const Eigen::Vector2d& at, double factor) {
  return (at - Eigen::Vector2d::Constant((factor - 1) / 2)) / factor;
}

}  // namespace priamos::head
