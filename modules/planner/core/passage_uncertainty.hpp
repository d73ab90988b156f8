#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/footprint.hpp"

namespace priamos::planner {

/// What the pose estimate's uncertainty will be worth in the plane of the door, if the base follows its path.
struct PassageUncertainty {
  double lateral_sigma_m = 0;    ///< across the door's axis
  double heading_sigma_rad = 0;  ///< against the door's axis
};

/// Carries a pose covariance (map: x, y, yaw) forward along the door's axis. A heading error grows into a
/// lateral one on the way, lateral = y + d yaw; the correlation that a landmark fix leaves between the two
/// makes most of it cancel at the landmark itself, so it must not be left out. Slip on the way is not in it.
PassageUncertainty AtDoor(const DoorPlan& door, const Pose2& map_from_base,
                          const Eigen::Matrix3d& map_covariance);

/// Half of the width the footprint takes when it goes through an opening turned by `heading_rad` [m].
double HalfWidthTurned(const Footprint& footprint, double heading_rad);

/// What is left of the gap on each side at 2 sigma [m]; negative when the footprint may touch.
double GapLeft(const DoorPlan& door, const Footprint& footprint, const PassageUncertainty& uncertainty);

}  // namespace priamos::planner
