#pragma once

#include <Eigen/Geometry>

#include "head/core/camera/camera_model.hpp"
#include "head/core/stand/vertical_direction.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// How a camera stands above a level floor.
struct CameraStand {
  double height_m = 0;  ///< of its optical centre above the floor
  double tilt_rad = 0;  ///< down is positive
  double roll_rad = 0;  ///< right side down is positive
};

/// Pose of the camera's own frame (x right, y down, z forward) in a base frame on the floor below it: x
/// forward, y left, z up.
Eigen::Isometry3d BaseFromCamera(const CameraStand& stand);

/// Tilt and roll of a camera in whose frame `up` points upwards.
CameraStand StandOf(const Eigen::Vector3d& up, double height_m);

/// Covariance of (tilt, roll) [rad^2].
Eigen::Matrix2d TiltAndRollCovariance(const VerticalDirection& vertical);

/// The camera as the base frame sees it whose origin lies on the floor below the camera that `camera` is
/// given in the frame of.
CameraModel OnTheFloor(CameraModel camera, const CameraStand& stand);

/// The view with `camera` for its camera, which differs from the view's own by the base frame alone.
CameraView SeenFrom(CameraView view, const CameraModel& camera);

}  // namespace priamos::head
