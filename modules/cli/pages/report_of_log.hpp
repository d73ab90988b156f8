#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_record.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// What a report needs of logs: of the robot's bus, the workstation's, both, or both in one merged log. Of
/// one bus alone the record has what crossed the radio of the other. Throws std::runtime_error, one sentence,
/// for a log that cannot be read or holds nothing of a robot.
RunRecord RecordOfLogs(const std::vector<std::string>& logs);

/// The report of a log as one self-contained page: outcome of the missions with reasons, map, alarms, looks,
/// plots, and what the radio carried. It needs no truth; with one (a simulated run) errors are plotted as
/// well.
std::string LogPage(const std::string& title, const RunRecord& record, const std::optional<GroundPlan>& plan);

}  // namespace priamos::cli
