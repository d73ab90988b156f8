#pragma once

#include <Eigen/Core>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/path/footprint.hpp"

namespace priamos::planner {

/// Growth of the pose error by odometry on the distance to the door. Over many slip lengths the errors walk
/// randomly, with the root of the distance; over short ones slip keeps its sign and adds less. The bias grows
/// with the distance. The values are those of the robot's own odometry model.
struct DriftModel {
  double slip_length_m = 0.3;
  double yaw_rad_per_sqrt_m = 0.0075;
  double lateral_m_per_sqrt_m = 0.005;
  double yaw_bias_rad_per_m = 0.003;

  void Describe(Archive& a);
};

/// Predicted uncertainty of the pose in the plane of the door, if the base follows its path.
struct PassageUncertainty {
  double lateral_sigma_m = 0;    ///< sigma of the position across the door's axis
  double heading_sigma_rad = 0;  ///< sigma of the heading relative to the door's axis
};

/// Carries a pose covariance (map: x, y, yaw) forward along the door's axis. A heading error grows into a
/// lateral one with the distance d, lateral = y + d yaw; the correlation that a landmark fix leaves between
/// the two makes most of it cancel at the landmark itself, so it must not be left out. The drift over the
/// distance still to go comes on top: seen from afar, even a perfect fix is not good enough.
PassageUncertainty AtDoor(const DoorPlan& door, const Pose2& map_from_base,
                          const Eigen::Matrix3d& map_covariance, const DriftModel& drift);

/// Half of the width the footprint takes when it goes through an opening turned by `heading_rad` [m].
double HalfWidthTurned(const Footprint& footprint, double heading_rad);

/// Free gap on each side at 2 sigma [m]; negative when the footprint may touch. The path following deviates
/// by `tracking_m`, also 2 sigma, whatever the error of the pose is.
double GapLeft(const DoorPlan& door, const Footprint& footprint, const PassageUncertainty& uncertainty,
               double tracking_m);

}  // namespace priamos::planner
