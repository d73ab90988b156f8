#include "head/core/edges/gradient_map.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

constexpr double kBlurSigma = 1.0;
/// Standard deviation that pixel noise of 1 has after the 5x5 Gaussian and a 3x3 Sobel.
constexpr double kGradientGain = 1.169;
/// Standard deviation of the mask [1 -2 1; -2 4 -2; 1 -2 1], for pixel noise of 1.
constexpr double kLaplaceGain = 6.0;
constexpr double kMedianToSigma = 1 / 0.6745;

void AddMagnitudes(const short* gx, const short* gy, unsigned short* out, int n) {
  for (int i = 0; i < n; ++i) out[i] = static_cast<unsigned short>(std::abs(gx[i]) + std::abs(gy[i]));
}

/// Median of a histogram, linear inside the bin: whole grey values alone would be too coarse.
double Median(const std::array<int, 2048>& histogram, int total) {
  double below = 0;
  for (std::size_t value = 0; value < histogram.size(); ++value) {
    if (below + histogram[value] >= total / 2.0) {
      const double inside = (total / 2.0 - below) / std::max(histogram[value], 1);
      return value == 0 ? 0.5 * inside : value - 0.5 + inside;
    }
    below += histogram[value];
  }
  return 0;
}

}  // namespace

void GradientMap::Compute(const cv::Mat& image) {
  EstimateNoise(image);
  cv::GaussianBlur(image, blurred_, {5, 5}, kBlurSigma, kBlurSigma, cv::BORDER_REPLICATE);
  cv::spatialGradient(blurred_, gx_, gy_, 3, cv::BORDER_REPLICATE);  // both Sobel sums in one pass
  magnitude_.create(image.size(), CV_16UC1);
  for (int y = 0; y < image.rows; ++y) {
    AddMagnitudes(gx_.ptr<short>(y), gy_.ptr<short>(y), magnitude_.ptr<unsigned short>(y), image.cols);
  }
}

double GradientMap::GradientNoise() const {
  return kGradientGain * noise_sigma_;
}

void GradientMap::EstimateNoise(const cv::Mat& image) {
  std::array<int, 2048> histogram{};
  int n = 0, n_saturated = 0;
  std::int64_t sum = 0;
  for (int y = 4; y + 1 < image.rows; y += 16) {
    const std::uint8_t *above = image.ptr(y - 1), *row = image.ptr(y), *below = image.ptr(y + 1);
    for (int x = 1; x + 1 < image.cols; x += 2) {
      const int mask = above[x - 1] - 2 * above[x] + above[x + 1] - 2 * row[x - 1] + 4 * row[x] -
                       2 * row[x + 1] + below[x - 1] - 2 * below[x] + below[x + 1];
      ++histogram[std::min(std::abs(mask), 2047)];
      n_saturated += row[x] == 0 || row[x] == 255;
      sum += row[x];
      ++n;
    }
  }
  noise_sigma_ = Median(histogram, n) * kMedianToSigma / kLaplaceGain;
  mean_grey_ = double(sum) / n;
  saturated_share_ = double(n_saturated) / n;
}

}  // namespace priamos::head
