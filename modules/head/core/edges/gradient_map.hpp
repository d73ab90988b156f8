#pragma once

#include <opencv2/core/mat.hpp>

namespace priamos::head {

/// Smoothed Sobel gradients of one grey image. The buffers are reused from image to image.
class GradientMap {
 public:
  /// Computes the gradients of an image, which is CV_8UC1, at least 16x16.
  void Compute(const cv::Mat& image);

  int width() const { return gx_.cols; }
  int height() const { return gx_.rows; }
  /// Sobel sums of the smoothed image: 8 times the slope in grey values per pixel.
  const short* gx(int row) const { return gx_.ptr<short>(row); }
  const short* gy(int row) const { return gy_.ptr<short>(row); }
  /// Magnitude of the gradients of one row: |gx| + |gy|.
  const unsigned short* magnitude(int row) const { return magnitude_.ptr<unsigned short>(row); }

  double noise_sigma() const { return noise_sigma_; }  ///< noise of a pixel of the raw image [grey values]
  double mean_grey() const { return mean_grey_; }
  double saturated_share() const { return saturated_share_; }
  /// Standard deviation that this noise gives gx and gy.
  double GradientNoise() const;

 private:
  void EstimateNoise(const cv::Mat& image);

  cv::Mat blurred_, gx_, gy_, magnitude_;
  double noise_sigma_ = 0, mean_grey_ = 0, saturated_share_ = 0;
};

}  // namespace priamos::head
