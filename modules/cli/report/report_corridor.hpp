#pragma once

#include <optional>

#include "cli/report/report_belief.hpp"
#include "cli/report/report_record.hpp"

namespace priamos::cli {

/// What the robot knew of its pose while it followed a corridor, judged by the truth.
struct CorridorSummary {
  double driven_m = 0;              ///< true distance
  double across_rms_m = 0;          ///< error across its true heading, after the first metres
  std::optional<BeliefAtDoor> end;  ///< at the end, in the frame of the true heading there
};

/// Summary of the drive along a corridor; nullopt when none was ordered. The plan's map must be that of the
/// world, up to what a survey has wrong.
std::optional<CorridorSummary> CorridorSummaryOf(const RunRecord& record);

}  // namespace priamos::cli
