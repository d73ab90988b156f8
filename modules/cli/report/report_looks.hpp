#pragma once

#include <string>

#include "cli/report/report_record.hpp"

namespace priamos::cli {

/// Every look of the run as a drawing of what the head saw: expected, matched and rejected edges, with the
/// verdict. Empty if there was none.
std::string LookDrawings(const RunRecord& record);

}  // namespace priamos::cli
