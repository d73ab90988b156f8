#include "cli/report/story_verdict.hpp"

namespace priamos::cli {

std::string Judge(const Scenario& scenario, const ScenarioStory& story, Summary& summary) {
  if (!story.DecidesTheRun()) return story.Reason();
  const std::string fault = summary.hand ? FaultOf(*summary.hand, scenario.longest_stop_s) : "";
  summary.passed = story.Succeeded() && fault.empty();
  return story.Succeeded() && !fault.empty() ? fault : story.Reason();
}

}  // namespace priamos::cli
