#include "head/core/edges/equal_contrast.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

namespace priamos::head {
namespace {

double Contrast(const cv::Mat& image) {
  cv::Scalar mean, sigma;
  cv::meanStdDev(image, mean, sigma);
  return sigma[0];
}

}  // namespace

std::vector<EdgeOperator::Options> ForOneScene(std::span<const cv::Mat> images,
                                               const EdgeOperator::Options& usual) {
  std::vector<double> contrasts;
  contrasts.reserve(images.size());
  for (const cv::Mat& image : images) contrasts.push_back(Contrast(image));
  const double largest = contrasts.empty() ? 0 : *std::max_element(contrasts.begin(), contrasts.end());
  const double least = std::min(kWeakestEdge, usual.min_contrast);
  std::vector<EdgeOperator::Options> all(images.size(), usual);
  for (std::size_t i = 0; i < all.size() && largest > 0; ++i)
    all[i].min_contrast = std::max(least, usual.min_contrast * contrasts[i] / largest);
  return all;
}

}  // namespace priamos::head
