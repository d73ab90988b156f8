#pragma once

#include <Eigen/Core>
#include <string>

#include "head/core/doors/door_detection.hpp"
#include "head/core/stand/camera_stand.hpp"

namespace priamos::head {

/// What told the height of a camera above the floor.
enum class HeightSource {
  kNothing,  ///< no door was seen: it is a usual height, good enough for nothing
  kFeet,     ///< uprights of doors that end on the floor
  kLintels,  ///< the usual height of lintels
};

/// In plain words.
const char* Describe(HeightSource source);

/// How a stereo pair stands, from its two images.
struct PairStand {
  VerticalDirection vertical;  ///< not found: nothing else is valid
  CameraStand stand;           ///< of the left camera
  double height_sigma_m = 0;
  HeightSource source = HeightSource::kNothing;
};

/// Stand of a stereo pair in whose images doors are to be found (DetectDoors). Both views are in the left
/// camera's own frame. Tilt and roll come from the edges of both images, the height from the doors of the
/// left image (DetectDoorsInImage); where it shows none, from what stereo tells of doors: where their
/// uprights end, and how high lintels usually are.
PairStand FindPairStand(const CameraView& left, const CameraView& right, const DoorDetectionOptions& options);

}  // namespace priamos::head
