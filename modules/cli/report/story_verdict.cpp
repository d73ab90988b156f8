#include "cli/report/story_verdict.hpp"

namespace priamos::cli {

std::string Judge(const Scenario& scenario, const ScenarioStory& story, Summary& summary) {
  if (!story.DecidesTheRun()) return story.Reason();
  std::string fault;
  if (summary.hand) fault = FaultOf(*summary.hand, scenario.longest_stop_s);
  if (fault.empty() && summary.explore) fault = FaultOf(*summary.explore, scenario.least_seen);
  summary.passed = story.Succeeded() && fault.empty();
  return story.Succeeded() && !fault.empty() ? fault : story.Reason();
}

}  // namespace priamos::cli
