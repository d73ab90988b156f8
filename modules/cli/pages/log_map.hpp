#pragma once

#include <cstdint>
#include <optional>

#include "cli/report/report_plan_view.hpp"
#include "cli/report/report_record.hpp"
#include "common/drawing/drawing.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// The floor that a log is about: the plan, and everywhere the robot believed to be.
Extent ExtentOfLog(const RunRecord& record, const std::optional<GroundPlan>& plan);

/// The map of a log: the plan, walls that were heard, the believed path with its uncertainty, the true one
/// where there is a truth; legend.
drawing::Drawing DrawLogMap(const RunRecord& record, const std::optional<GroundPlan>& plan,
                            const Extent& extent);

/// What of a record DrawLogMap draws, as it was at a time [us].
RunRecord MapRecordUntil(const RunRecord& record, std::int64_t utime);

}  // namespace priamos::cli
