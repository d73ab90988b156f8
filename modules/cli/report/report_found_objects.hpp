#pragma once

#include <optional>

#include "cli/report/report_record.hpp"
#include "cli/report/run_info.hpp"

namespace priamos::cli {

/// Things that the head put together from edges of space, judged by the truth: each from where the robot
/// believed to be when it was seen last.
struct FoundObjects {
  int edges = 0, faces = 0, boxes = 0;  ///< that were told
  int standing = 0;        ///< of which at least half of the front lies within 10 cm of a true surface
  int phantoms = 0;        ///< of which no part of the front does
  double front_p95_m = 0;  ///< 95 % of all fronts are no farther from the nearest true surface

  int told() const { return edges + faces + boxes; }
};

/// nullopt when nothing was told. What is told counts as the planner keeps it.
std::optional<FoundObjects> FoundObjectsOf(const RunRecord& record, const RunInfo& info);

}  // namespace priamos::cli
