#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/report/report_record.hpp"

namespace priamos::cli {

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
