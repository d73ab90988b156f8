#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "world/core/camera/imaging.hpp"
#include "world/core/camera/optics.hpp"

namespace priamos::world {

/// The grid on which sub-exposures are drawn: finer than the image, with a margin that the lens distortion
/// needs, free of distortion itself.
struct FineGrid {
  static constexpr int kScale = 2;
  static constexpr int kMargin_px = 24;
  static constexpr int kWidth = (kImageWidth_px + 2 * kMargin_px) * kScale;
  static constexpr int kHeight = (kImageHeight_px + 2 * kMargin_px) * kScale;

  /// Place of an undistorted image point on the grid; (0,0) is the corner of its first cell.
  static Eigen::Vector2d FromImage(const Eigen::Vector2d& px) {
    return kScale * (px + Eigen::Vector2d::Constant(0.5 + kMargin_px));
  }
};

/// Where within every cell of the fine grid sub-exposure k of n samples, 0..1 each: a pattern that has every
/// column and every row of n x n once, so that an upright edge meets n different columns.
Eigen::Vector2d SubSample(int k, int n);

/// Turns light on the fine grid into the picture of one camera.
/// `light`: CV_32F, 1 is white under full light. `defocus_px`: sigma of wrong focus.
GreyImage FormImage(const ImagingConfig& config, const TrueCamera& camera, double defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng);
/// The same where things are differently sharp: `defocus_px` (CV_64F) over equal parts of the fine grid.
GreyImage FormImage(const ImagingConfig& config, const TrueCamera& camera, const cv::Mat& defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng);

}  // namespace priamos::world
