#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "world/core/camera/fine_grid.hpp"
#include "world/core/camera/imaging.hpp"
#include "world/core/camera/lens_map.hpp"

namespace priamos::world {

/// Where within every cell of the fine grid sub-exposure k of n samples, 0..1 each: a pattern that has every
/// column and every row of n x n once, so that an upright edge meets n different columns.
Eigen::Vector2d SubSample(int k, int n);

/// Turns light on the fine grid into the picture of one camera.
/// `light`: CV_32F of the fine grid, 1 is white under full light. `defocus_px`: sigma of wrong focus.
GreyImage FormImage(const ImagingConfig& config, const LensMap& lens, double defocus_px, const cv::Mat& light,
                    const Exposure& exposure, Rng& rng);
/// The same where things are differently sharp: `defocus_px` (CV_64F) over equal parts of the fine grid.
GreyImage FormImage(const ImagingConfig& config, const LensMap& lens, const cv::Mat& defocus_px,
                    const cv::Mat& light, const Exposure& exposure, Rng& rng);

}  // namespace priamos::world
