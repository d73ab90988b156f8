#pragma once

#include <string>

#include "cli/report/report_record.hpp"
#include "cli/report/report_summary.hpp"

namespace priamos::cli {

/// The report of a run as one self-contained page: key figures, the picture (`svg`, embedded), the phases of
/// the mission, fixes, radio, and plots over time. It needs no script and no external resource, and reads on
/// a telephone as well as on a screen.
std::string ReportPage(const RunRecord& record, const Summary& summary, const std::string& svg);

}  // namespace priamos::cli
