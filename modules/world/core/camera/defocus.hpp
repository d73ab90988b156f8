#pragma once

#include <opencv2/core.hpp>

namespace priamos::world {

/// Area of a pixel and Gaussian blur of `sigma_px` (pixels of the image) in one, as a row for the fine grid.
cv::Mat PixelKernel(double sigma_px);

/// Light on the fine grid (CV_32F) as a lens draws it whose blur is not everywhere the same. `sigma_px`
/// (CV_64F): the standard deviation of all blur over equal parts of the grid, of any size; between their
/// middles it is linear. Between at most four blurs of the whole grid what is seen is mixed.
cv::Mat Blurred(const cv::Mat& light, const cv::Mat& sigma_px);

}  // namespace priamos::world
