#pragma once

#include <Eigen/Core>

#include "head/core/doors/door_outlines.hpp"
#include "head/core/stand/camera_stand.hpp"

namespace priamos::head {

/// What an outline is like per metre of its lintel's height above the camera, and how exactly that is seen.
struct OutlineGauge {
  double yaw_rad = 0;  ///< through the outline, counter-clockwise from where the camera looks
  double width = 0, range = 0;
  double yaw_sigma_rad = 0, width_sigma = 0, range_sigma = 0;
};

/// Gauges an outline by its corners. `camera` is in its own frame; `corner_sigma_px` is how exactly edges
/// of frames tell the corners, `covariance` that of the stand's tilt and roll [rad^2]. Not finite where the
/// corners are not above the camera.
OutlineGauge GaugeOutline(const DoorOutline& outline, const CameraModel& camera, const CameraStand& stand,
                          const Eigen::Matrix2d& covariance, double corner_sigma_px);

}  // namespace priamos::head
