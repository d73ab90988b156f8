#pragma once

#include <optional>

#include "cli/report/report_record.hpp"
#include "cli/report/run_info.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// The door that was to be passed, as it was built; as drawn when the world of the run is not known.
std::optional<DoorPlan> BuiltDoor(const RunInfo& info);

/// The record with the truth as the robot knows it: by its place at the door. Where the plan is wrong, a pose
/// that is right at the door is off in the map. Without a door the record as it is.
RunRecord OnPlan(RunRecord record, const RunInfo& info);

}  // namespace priamos::cli
