#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "common/config.hpp"
#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "world/core/optics.hpp"

namespace priamos::world {

/// Lens blur, sensor and noise, alike for the three cameras.
struct ImagingConfig {
  int sub_exposures = 4;       ///< pictures over the exposure time that are averaged
  double blur_px = 0.6;        ///< sigma of the lens at best focus
  double defocus_px = 4.0;     ///< sigma per dioptre of wrong focus at 1000 px focal length
  double vignetting = 0.25;    ///< loss of light in the corners at 800 px focal length
  double read_noise = 1.2;     ///< sigma [grey levels] at gain 1
  double photon_noise = 0.02;  ///< variance per grey level at gain 1
  double black_level = 8;      ///< grey level without light
  double white_level = 230;    ///< grey level of white under full light at 10 ms, gain 1

  void Describe(Archive& a);
};

/// Settings of one exposure.
struct Exposure {
  double exposure_s = 0.010;
  double gain = 1;
  double camera_light = 0;  ///< lamp beside the lens; 1 makes retro-reflective discs white at 10 ms, gain 1
  double laser = 0;         ///< the laser line; 1 makes it white at 10 ms, gain 1
};

/// The grid on which sub-exposures are drawn: finer than the image, with a margin that the lens distortion
/// needs, free of distortion itself.
struct FineGrid {
  static constexpr int kScale = 2;
  static constexpr int kMarginPx = 24;
  static constexpr int kWidth = (kImageWidthPx + 2 * kMarginPx) * kScale;
  static constexpr int kHeight = (kImageHeightPx + 2 * kMarginPx) * kScale;

  /// Place of an undistorted image point on the grid; (0,0) is the corner of its first cell.
  static Eigen::Vector2d FromImage(const Eigen::Vector2d& px) {
    return kScale * (px + Eigen::Vector2d::Constant(0.5 + kMarginPx));
  }
};

/// Where within every cell of the fine grid sub-exposure k of n samples, 0..1 each: a pattern that has every
/// column and every row of n x n once, so that an upright edge meets n different columns.
Eigen::Vector2d SubSample(int k, int n);

/// Turns light on the fine grid into the picture of one camera.
/// `light`: CV_32F, 1 is white under full light. `defocus_px`: sigma of wrong focus.
GreyImage FormImage(const ImagingConfig& config, const TrueCamera& camera, double defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng);

}  // namespace priamos::world
