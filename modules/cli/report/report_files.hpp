#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/report/report_record.hpp"
#include "cli/report/report_summary.hpp"
#include "cli/report/report_table.hpp"

namespace priamos::cli {

/// The door `id` of a ground plan file, if it has one. Throws ConfigError when the plan cannot be used, or
/// has no such door though it is `needed`.
std::optional<DoorPlan> LoadDoor(const std::string& map_file, int id, bool needed);

/// How JSON is written: on one line for programs, indented for people.
enum class JsonForm { kOneLine, kIndented };

/// summary.json of one run, of several an array of them; without the end of the last line.
std::string SummariesAsJson(const std::vector<Summary>& runs, JsonForm form);

/// Writes summary.json, run.svg and run.png (the same picture) and report.html into `folder`. Throws
/// ConfigError for a ground plan that cannot be used, std::runtime_error naming a file that cannot be
/// written.
void WriteReport(const RunRecord& record, const Summary& summary, const RunInfo& info,
                 const std::string& map_file, const std::filesystem::path& folder);

}  // namespace priamos::cli
