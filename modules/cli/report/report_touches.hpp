#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_record.hpp"

namespace priamos::cli {

/// A touch, and when the robot knew of it.
struct TouchSummary {
  double t_s = 0;     ///< since the order
  std::string kind;   ///< "driven", "moved in" or "fell", as in world_touch_t
  std::string thing;  ///< what was touched
  /// Until DRIVE_STATUS says that something was touched or that the wheels are stuck; none: not
  /// within 30 s.
  std::optional<double> noticed_after_s;
};

/// Every touch of the run, in order; `begin_utime` is when the order was given.
std::vector<TouchSummary> TouchesOf(const RunRecord& record, std::int64_t begin_utime);

/// For summary.json.
nlohmann::ordered_json ToJson(const TouchSummary& touch);

}  // namespace priamos::cli
