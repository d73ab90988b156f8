#pragma once

#include <vector>

#include "common/random.hpp"
#include "common/reference_object.hpp"
#include "head/core/calibration/discs/disc_fit.hpp"

namespace priamos::support {

/// The object shipped in config/sim.
ReferenceObject ShippedReferenceObject();

/// Where a camera stands before the reference object, and its lens.
struct CameraView {
  double focal_px = 1000;
  double distance_m = 1.5;                 ///< to `target_m`
  double azimuth_rad = 0;                  ///< of the camera, seen from the object, positive to its +y side
  double elevation_rad = 0;                ///< of the camera, positive above
  double roll_rad = 0;                     ///< of the image, clockwise as seen
  Eigen::Vector3d target_m{0.12, 0, 0};    ///< point of the object that the camera looks at
  Eigen::Vector2d target_offset_px{0, 0};  ///< of its image from the principal point
  Eigen::Vector2d centre_px{383.5, 287.5};
  double k1 = 0, k2 = 0;
};

/// The camera in the frame of the object; its distortion is in units of the focal length.
head::CameraModel MakeCamera(const CameraView& view);

/// Any view within +-35 degrees and 1-4 m, 800-1600 px, that has the whole object in the image.
CameraView RandomView(Rng& rng);

/// Whether the whole disc is visible past the blocks of the object.
bool Unhidden(const ReferenceObject& object, const ReferenceDisc& disc, const Eigen::Vector3d& eye_m);

/// What a detector would report of the visible discs, in any order: up to `hidden` discs are left out (those
/// behind blocks count), `clutter` other bright ellipses are added, everything with the noise of a detector.
/// `truth[i]` is the disc that detection i is, -1 for clutter.
struct Sightings {
  std::vector<head::DetectedDisc> detections;
  std::vector<int> truth;
  int visible = 0;
};
Sightings Sight(const ReferenceObject& object, const head::CameraModel& camera, int hidden, int clutter,
                Rng& rng);

/// The image of the discs that `truth` names before a black body, with other bright spots and rectangles
/// around it; gain, blur and background are random.
GreyImage RenderSightings(const ReferenceObject& object, const head::CameraModel& camera,
                          const std::vector<int>& truth, Rng& rng);

/// The optical centre.
Eigen::Vector3d EyeOf(const head::CameraModel& camera);

}  // namespace priamos::support
