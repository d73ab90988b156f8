#pragma once

#include <span>

#include "head/core/calibration/disc_projection.hpp"
#include "head/core/calibration/outcome.hpp"

namespace priamos::head {

/// A measured disc. Until its bias is taken off, the centroid is not the image of the disc's centre.
struct DiscObservation {
  ReferenceDisc disc;  ///< in the base frame
  Eigen::Vector2d centroid_px = Eigen::Vector2d::Zero();
  double sigma_px = 0.02;
};

/// What is known of a camera without measuring: data sheet, as mean and standard deviation. One view of a
/// small object says little about some of these, and what it says then comes from noise.
struct LensKnowledge {
  Eigen::Vector2d centre_px{383.5, 287.5};
  double centre_sigma_px = 15;
  double aspect = 1, aspect_sigma = 0.0005;  ///< pixel height over width
  double skew_sigma_rad = 0.0005;
  double k1_sigma = 0.1, k2_sigma = 0.02;  ///< at one focal length from the centre
};

/// Minimises the reprojection error over the 11 parameters of the camera and two of radial distortion,
/// starting from `start`. The observed centroids are compared with `bias` pixels added to the image of the
/// centre. Refuses a start that shows a disc behind the camera, and numbers that are not finite.
Outcome<CameraModel> RefineCamera(std::span<const DiscObservation> observations,
                                  std::span<const Eigen::Vector2d> bias, const CameraModel& start,
                                  const LensKnowledge& lens = {});

}  // namespace priamos::head
