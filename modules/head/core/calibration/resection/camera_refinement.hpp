#pragma once

#include <span>
#include <vector>

#include "common/image_size.hpp"
#include "common/outcome.hpp"
#include "head/core/calibration/discs/disc_projection.hpp"

namespace priamos::head {

/// A measured disc. Until its bias is taken off, the centroid is not the image of the disc's centre.
struct DiscObservation {
  ReferenceDisc disc;  ///< in the base frame
  Eigen::Vector2d centroid_px = Eigen::Vector2d::Zero();
  double sigma_px = 0.02;
};

/// What is known of a camera without measuring: data sheet, as mean and standard deviation. One view of a
/// small object hardly determines some of these, and without the prior noise would.
struct LensKnowledge {
  Eigen::Vector2d centre_px = ImageSize{}.Centre();
  double centre_sigma_px = 15;
  double aspect = 1, aspect_sigma = 0.0005;  ///< pixel height over width
  double skew_sigma_rad = 0.0005;
  double k1_sigma = 0.1, k2_sigma = 0.02;  ///< at one focal length from the centre
  double worst_error_px = 1;               ///< a larger F comes from wrong correspondences
};

/// Measurements of one picture for the refinement of its camera.
struct RefinementView {
  std::span<const DiscObservation> observations;
  std::span<const Eigen::Vector2d> bias;  ///< to be taken off the observed centroids [px]
  CameraModel start;
};

/// Minimises the reprojection error of several pictures of one camera at one zoom and focus: 6 parameters of
/// pose per picture, 5 of the lens and two of radial distortion for all together. One picture shows the discs
/// only in the middle of the image; what the lens does at the rim takes more of them. Refuses no view, a
/// start that shows a disc behind the camera, and numbers that are not finite.
Outcome<std::vector<CameraModel>> RefineViews(std::span<const RefinementView> views,
                                              const LensKnowledge& lens = {});

/// Minimises the reprojection error of a single picture as RefineViews does: all 11 parameters of the camera
/// and two of radial distortion.
Outcome<CameraModel> RefineCamera(std::span<const DiscObservation> observations,
                                  std::span<const Eigen::Vector2d> bias, const CameraModel& start,
                                  const LensKnowledge& lens = {});

}  // namespace priamos::head
