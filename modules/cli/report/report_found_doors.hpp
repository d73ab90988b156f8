#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_record.hpp"
#include "cli/report/run_info.hpp"

namespace priamos::cli {

/// A door on the way of the base, and what came to the workstation of it.
struct FoundDoor {
  std::string name;
  std::string state;  ///< closed, ajar (up to 30 degrees) or open, as it truly was
  double open_deg = 0;
  std::optional<std::string> told;  ///< state that was told; nullopt: the door was not found
  /// Where it was told, less where it truly was from the robot when it was seen last: along the wall, across
  /// it.
  double along_m = 0, across_m = 0;
  double sigma_along_m = 0, sigma_across_m = 0;  ///< as told
};

/// Doors that the head found without a map, judged by the truth.
struct FoundDoors {
  std::vector<FoundDoor> on_the_way;  ///< that the base truly came past
  int false_ones = 0;                 ///< told where none is
};

/// nullopt when nothing was told and no corridor was ordered. What is told counts as the planner keeps it.
std::optional<FoundDoors> FoundDoorsOf(const RunRecord& record, const RunInfo& info);

}  // namespace priamos::cli
