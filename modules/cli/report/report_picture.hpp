#pragma once

#include "cli/report/report_record.hpp"
#include "cli/report/report_summary.hpp"
#include "common/drawing/drawing.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// The picture of a run (run.svg, run.png): the ground plan with axes in metres, what stands in it, true and
/// believed path, robot and fixes; the legend of all of it; the door enlarged, the pose errors at the fixes,
/// and the run's figures. 1200 px wide, as high as it needs; its text can be read at a third of that. An
/// empty record gives plan and legend.
drawing::Drawing DrawRun(const RunRecord& record, const Summary& summary, const RunInfo& info,
                         const GroundPlan& plan);

}  // namespace priamos::cli
