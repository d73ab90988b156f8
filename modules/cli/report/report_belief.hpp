#pragma once

#include <nlohmann/json_fwd.hpp>
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

/// How landmark fixes agreed with what the robot expected of them.
struct CorrectionSummary {
  int count = 0;           ///< fixes that were compared with the estimate, applied or refused as implausible
  int beyond_3_sigma = 0;  ///< of these, less likely than 3 sigmas are in one dimension
  double most_distance = 0;  ///< the largest Mahalanobis distance, 3 degrees of freedom
};

/// The Mahalanobis distance that is exceeded as rarely with 3 degrees of freedom as 3 sigmas are with one:
/// once in 370.
inline constexpr double kThreeSigmas = 3.7625;

/// Of all POSE_CORRECTION messages; fixes that were too old, resets and looks without a fix do not count.
CorrectionSummary CorrectionsOf(const RunRecord& record);

/// For summary.json.
nlohmann::ordered_json ToJson(const CorrectionSummary& corrections);

}  // namespace priamos::cli
