#pragma once

#include <opencv2/core.hpp>

#include "cli/report_record.hpp"
#include "cli/report_summary.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// The picture of a run (run.png): the ground plan with door, true path, believed path with its covariance
/// ellipses (2 sigma) and the fixes; below it the passage enlarged, the pose errors at the fixes, and a
/// legend. 1600 x 1236 pixels, BGR. An empty record gives the plan alone.
cv::Mat DrawRun(const RunRecord& record, const Summary& summary, const RunInfo& info, const GroundPlan& plan);

}  // namespace priamos::cli
