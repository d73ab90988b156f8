#pragma once

#include <string>

#include "cli/report/report_summary.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/scenario/scenario_story.hpp"

namespace priamos::cli {

/// Completes `summary.passed` with what the record alone does not show: a drive by hand, or
/// an exploration, passes when its story came to a good end and it did nothing that the scenario forbids, and
/// saw as much as that asks. Returns why it has not passed; the
/// story's last line when it has.
std::string Judge(const Scenario& scenario, const ScenarioStory& story, Summary& summary);

}  // namespace priamos::cli
