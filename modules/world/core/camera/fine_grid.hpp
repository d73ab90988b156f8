#pragma once

#include <Eigen/Core>

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

}  // namespace priamos::world
