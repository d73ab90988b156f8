#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "cli/report_record.hpp"
#include "cli/report_summary.hpp"

namespace priamos::cli {

/// RFC 4648, with padding.
std::string Base64(std::span<const std::uint8_t> bytes);

/// The report of a run as one self-contained page: key figures, the picture (`png`, embedded), the phases of
/// the mission, fixes, radio, and plots over time. It needs no script and no external resource, and reads on
/// a telephone as well as on a screen.
std::string ReportPage(const RunRecord& record, const Summary& summary, std::span<const std::uint8_t> png);

}  // namespace priamos::cli
