#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "head/core/doors/door_outlines.hpp"
#include "head/core/stand/camera_stand.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A door found in one image. Its metres are right up to one scale, which is that of
/// DoorsInImage::height_m; their standard deviations contain it.
struct ImageDoor {
  std::array<Eigen::Vector2d, 2> corners;  ///< upper ends of the uprights, left and right [undistorted px]
  std::array<Eigen::Vector2d, 2> feet;     ///< where they meet the floor, maybe out of the picture
  /// Middle between the uprights; x away from the camera, through the door. Base: on the floor below the
  /// camera, x where it looks.
  Pose2 base_from_door;
  double yaw_sigma_rad = 0;               ///< of the direction through the door
  double width_m = 0, height_m = 0;       ///< between the uprights; of the lintel above the floor
  double shape = 0, shape_sigma = 0;      ///< width over height, which no scale changes
  double range_m = 0, range_sigma_m = 0;  ///< from below the camera to the middle
  bool on_floor = false;                  ///< an upright was seen down to the floor
  double log_odds = 0;                    ///< log odds of a door against whatever else has uprights
};

/// The doors of one image, and the height of the camera above the floor that they agree on.
struct DoorsInImage {
  std::vector<ImageDoor> doors;
  double height_m = 0, height_sigma_m = 0;  ///< of the camera; 0 if it was told
};

/// Size of doors, and what evidence is wanted.
struct ImageDoorOptions {
  double min_width_m = 0.62, max_width_m = 1.4;
  double min_height_m = 1.85, max_height_m = 2.35;
  double usual_height_m = 2.05, height_sigma_m = 0.1;  ///< of lintels
  double min_camera_m = 0.8, max_camera_m = 1.8;       ///< heights of a camera that nobody told
  double usual_camera_m = 1.3, camera_sigma_m = 0.3;   ///< prior of that
  double min_log_odds = 1.2;                           ///< log odds wanted
  double same_door_m = 0.6;      ///< middles nearer to each other are one door, such as frame and open leaf
  double corner_sigma_px = 0.3;  ///< deviation of a frame's edges from its corners
  double foot_share = 0.045;     ///< deviation of seen feet from the floor, of the camera's height
  OutlineOptions outlines{};
};

/// Doors, open or closed, in one image of a calibrated camera: outlines of uprights through the vertical
/// vanishing point with a level lintel, weighed. `view` is in the camera's own frame (x right, y down, z
/// forward), `stand` how it stands, with the covariance of tilt and roll. Without `height_m` the camera's
/// height above the floor, which one image does not show, is the one at which its doors are of usual height.
DoorsInImage DetectDoorsInImage(const CameraView& view, const CameraStand& stand,
                                const Eigen::Matrix2d& covariance, std::optional<double> height_m,
                                const ImageDoorOptions& options);

}  // namespace priamos::head
