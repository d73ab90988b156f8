#pragma once

#include <iosfwd>
#include <string>

#include "cli/report/report_summary.hpp"

namespace priamos::cli {

/// "passed, nothing touched" and the like: one run in a few words.
std::string Verdict(const Summary& summary);

/// What a person reads in the terminal after a run.
void PrintSummary(std::ostream& out, const Summary& summary);

}  // namespace priamos::cli
