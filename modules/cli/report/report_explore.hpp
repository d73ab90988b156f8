#pragma once

#include <optional>
#include <string>

#include "cli/report/report_record.hpp"
#include "cli/report/run_info.hpp"

namespace priamos::cli {

/// What came of the exploration of a floor, judged by the truth.
struct ExploreSummary {
  double reachable_m2 = 0;  ///< floor that the base could drive over, 10 cm off everything, from its start
  double seen = 0;          ///< share of it that truly was in sight of the base, 2 m at most
  double driven_m = 0;      ///< true distance
  double tour_m = 0;        ///< the best way found, knowing the floor, to places that see 98 % of it
  int tour_places = 0;      ///< how many of these there are
  double wall_m = 0;        ///< length of the walls that came to the planner, without edges
  double wall_error_p95_m =
      0;  ///< of their places from the nearest true face, the whole map turned and moved to fit
  double pose_error_m = 0;  ///< at the end, in the frame of the first pose
  double pose_error_deg = 0;
  std::string end;  ///< how it ended, in the planner's words
};

/// Summary of an exploration; nullopt when none was ordered.
std::optional<ExploreSummary> ExploreSummaryOf(const RunRecord& record, const RunInfo& info);

/// `seen 99.2 % of 35.8 m2`.
std::string SeenText(const ExploreSummary& explore);

/// Why an exploration that came to its end has not passed, in words; empty if it has. `least_seen` as in
/// Scenario.
std::string FaultOf(const ExploreSummary& explore, double least_seen);

}  // namespace priamos::cli
