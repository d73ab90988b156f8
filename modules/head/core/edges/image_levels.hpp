#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace priamos::head {

/// Smallest side of a level of an image pyramid [px]: what EdgeOperator takes.
inline constexpr int kLeastSide_px = 32;

/// Sets `half` to the next level of an image pyramid, without an odd last row and column, so that a pixel is
/// exactly the mean of four. False, and nothing done, if its smaller side would be below kLeastSide_px.
bool Halve(const cv::Mat& image, cv::Mat& half);

/// A point of a level whose pixels are `factor` pixels of the whole image wide, in the pixels of the whole
/// image, and back. Pixels are counted from their centres.
Eigen::Vector2d ToWhole(const Eigen::Vector2d& at, double factor);
Eigen::Vector2d ToLevel(const Eigen::Vector2d& at, double factor);

}  // namespace priamos::head
