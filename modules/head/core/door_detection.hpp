#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"
#include "head/core/vertical_stereo.hpp"

namespace priamos::head {

/// A door that no map told of: two uprights with a lintel between their tops, seen by both cameras.
struct DetectedDoor {
  Pose2 base_from_door;        ///< middle between the uprights; x away from the robot, through the door
  Eigen::Matrix2d covariance;  ///< of that middle [m^2]
  double width_m = 0;          ///< between the uprights: the frame's outer or inner edges
  double height_m = 0;         ///< of the lintel
  bool on_floor = false;       ///< an upright was seen down to the floor
};

struct DoorDetectionOptions {
  double min_width_m = 0.65, max_width_m = 1.35;
  double min_height_m = 1.85, max_height_m = 2.35;
  double floor_m = 0.12;        ///< an upright whose end is in the picture must come down to this
  double corner_px = 6;         ///< of the end of the lintel from the upright
  double level_m = 0.02;        ///< the lintel's heights over both uprights, and from both cameras
  double max_missing_m = 0.25;  ///< upright that is not seen below the lintel
  double min_upright_m = 0.5;   ///< seen by both cameras
  double same_door_m = 0.65;    ///< nearer ones are one door, such as frame and open leaf
  VerticalStereoOptions stereo{.max_range_m = 6, .camera_sigma_px = 0.05};
};

/// Doors, open or closed, in a stereo pair: the conclusion of the paper. The corners of lintel and uprights
/// decide which uprights belong together; the position is metric by stereo. Nothing is remembered from look
/// to look.
std::vector<DetectedDoor> DetectDoors(const CameraView& left, const CameraView& right,
                                      const DoorDetectionOptions& options);

}  // namespace priamos::head
