#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/stereo/vertical_stereo.hpp"

namespace priamos::head {

/// A door found without a map: two uprights with a lintel between their tops, seen by both cameras.
struct DetectedDoor {
  Pose2 base_from_door;        ///< middle between the uprights; x away from the robot, through the door
  Eigen::Matrix2d covariance;  ///< covariance of that middle (x, y) [m^2]
  double width_m = 0;          ///< distance of the uprights: the frame's outer or inner edges
  double height_m = 0;         ///< height of the lintel above the floor
  bool on_floor = false;       ///< an upright was seen down to the floor
  double log_odds = 0;         ///< log odds of a door against whatever else has uprights
};

/// Size of doors, how well edges agree with one, and what evidence is wanted.
struct DoorDetectionOptions {
  double min_width_m = 0.65, max_width_m = 1.35;
  double min_height_m = 1.85, max_height_m = 2.35;
  double usual_height_m = 2.05,
         height_sigma_m = 0.1;                       ///< prior of the lintel's height, with or without frame
  double usual_width_m = 0.95, width_sigma_m = 0.2;  ///< prior of the width
  double level_sigma_m = 0.012;  ///< difference of the lintel's heights over both uprights
  double edge_sigma_px = 0.3;    ///< deviation of frames from two uprights and a level lintel
  double frame_sigma_m = 0.004;  ///< deviation of a frame's edges from one plane and symmetry, part of the
                                 ///< covariance: near jambs show another edge of the frame than far ones
  double min_upright_m = 0.15;   ///< shortest part of an upright that both cameras must see
  double min_log_odds = 7;       ///< log odds wanted
  double same_door_m = 0.65;  ///< candidates nearer to each other are one door, such as frame and open leaf
  VerticalStereoOptions stereo{.max_range_m = 8, .camera_sigma_px = 0.05};
};

/// Edge operator for the search of doors. It finds fainter edges than elsewhere, because in a dim corridor
/// frame and wall have nearly the same brightness; a single wrong edge does not make a door.
inline EdgeOperator::Options DoorEdges() {
  EdgeOperator::Options options;
  options.min_contrast = 5;
  return options;
}

/// Doors, open or closed, in a stereo pair: the conclusion of the paper. Every pair of uprights of a door's
/// width with a level line of a door's height over both is weighed in both images (WeighDoor); the best are
/// doors. The position is metric by stereo. Nothing is kept from look to look.
std::vector<DetectedDoor> DetectDoors(const CameraView& left, const CameraView& right,
                                      const DoorDetectionOptions& options);

}  // namespace priamos::head
