#pragma once

#include <optional>

#include "cli/report/report_record.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// What the robot believed in the plane of the door, judged by the truth.
struct BeliefAtDoor {
  double lateral_m = 0;        ///< believed minus true, across the door, positive to the left
  double along_m = 0;          ///< believed minus true, along the door's axis
  double heading_rad = 0;      ///< believed minus true
  double lateral_sigma_m = 0;  ///< the error across the door that the robot expects, one sigma
  /// Normalised estimation error squared of x, y and heading: chi-square with 3 degrees of freedom when the
  /// covariance is right, 3 in the mean.
  double nees = 0;
};

/// The pose nearest in time to `utime`, when the base passed the door. `record` must be on the plan, as
/// OnPlan() makes it, and `door` is that of the plan. nullopt without a pose or truth near that time, or with
/// a covariance that cannot be inverted.
std::optional<BeliefAtDoor> BeliefAt(const RunRecord& record, const DoorPlan& door, std::int64_t utime);

}  // namespace priamos::cli
