#include "cli/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/scenario/story_registry.hpp"
#include "common/config.hpp"
#include "common/data_folders.hpp"
#include "common/ground_plan.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

std::vector<std::string> KnownScenarios(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> StoryNames() {
  std::vector<std::string> names;
  for (const StoryKind& kind : Stories()) names.emplace_back(kind.name);
  return names;
}

/// "door: the planner passes it; teleop: an operator drives".
std::string StoryMeanings() {
  std::vector<std::string> meanings;
  for (const StoryKind& kind : Stories()) meanings.push_back(fmt::format("{}: {}", kind.name, kind.summary));
  return fmt::format("{}", fmt::join(meanings, "; "));
}

/// "none; sim has some", for a deployment without any.
[[noreturn]] void RefuseWithoutScenarios(const std::filesystem::path& folder, const std::string& name) {
  std::vector<std::string> others;
  const ProgramPlace place = ThisProgram();
  for (const std::string& other : KnownDeployments(place))
    if (!KnownScenarios(std::filesystem::path(FindDeployment(other, place)) / "scenarios").empty())
      others.push_back(other);
  const std::string next =
      others.empty() ? "" : fmt::format("; next: --deployment {}, which has some", fmt::join(others, " or "));
  throw ConfigError(
      fmt::format("scenario: expected one of the deployment {}, got \"{}\": it has no scenarios{}",
                  folder.string(), name, next));
}

/// What a run would find out after a minute, if at all. A list of processes that is not there is none to
/// judge.
void CheckProcesses(const Scenario& scenario, Archive& a) {
  const auto& all = scenario.processes;
  const auto is_there = [&](std::string_view module, std::string_view bus, auto end) {
    return std::any_of(all.begin(), end,
                       [&](const ScenarioProcess& p) { return p.module == module && p.bus == bus; });
  };
  for (auto p = all.begin(); p != all.end(); ++p)
    if (is_there(p->module, p->bus, p))
      a.Refuse("process",
               fmt::format("each module once on a bus, and {} only once on {}", p->module, p->bus));
  const StoryKind& story = FindStory(scenario.story);
  if (story.needs_planner && !all.empty() && !is_there("planner", "offboard", all.end()))
    a.Refuse("process", fmt::format("a planner on the bus offboard, which the story {} gives its orders to",
                                    scenario.story));
  if (story.needs_waypoints && scenario.waypoints.empty())
    a.Refuse("waypoint",
             fmt::format("[[waypoint]] with x_m and y_m, one at least for the story {}", scenario.story));
}

}  // namespace

bool IsHostName(std::string_view name) {
  const auto allowed = [](char c) { return c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z'); };
  return !name.empty() && name.size() <= kLongestHostName && std::all_of(name.begin(), name.end(), allowed);
}

void Scenario::Describe(Archive& a) {
  a.Text("title", title, "what happens, in a few words");
  a.Choice("story", story, StoryNames(), StoryMeanings());
  a.Integer("landmark_id", landmark_id, {"-", 0, kLastLandmarkId, "the door of the map to pass"});
  a.Number("time_limit_s", time_limit_s, {"s", 1, 100000, "the run is ended after that"});
  a.Text("map", map, "ground plan drawn in the report, relative to the deployment's folder");
  a.Flag("fast", fast, "the operator uses the fast range");
  a.Number("astray_deg", astray_deg,
           {"deg", 0, 90, "error of the direction in which he pushes, one sigma; above 0 he also pauses"});
  a.Number("longest_stop_s", longest_stop_s,
           {"s", 0, 1000, "not passed when the base stands in the passage for longer while pushed; 0: any"});
  a.Number("least_seen", least_seen,
           {"-", 0, 1, "not passed when an exploration sees less of the floor that it can reach; 0: any"});
  a.Number("shake_s", shake_s, {"s", 1, 100000, "how long he shakes it"});
  // What has a heading in TOML comes last: single values after it would belong to it.
  a.Section("line", line, "the serial line between the two radios");
  a.List("process", processes, "the processes, in order of start");
  a.List("waypoint", waypoints, "where the operator drives; none: he shakes the stick at random");
  CheckProcesses(*this, a);
}

Scenario LoadScenario(const std::string& folder, const std::string& name) {
  const auto scenarios = std::filesystem::path(folder) / "scenarios";
  const auto known = KnownScenarios(scenarios);
  if (known.empty()) RefuseWithoutScenarios(folder, name);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw ConfigError(fmt::format("{}: expected a scenario ({}), got \"{}\"{}", scenarios.string(),
                                  fmt::join(known, ", "), name, NearestText(name, known)));
  }
  return LoadConfig<Scenario>((scenarios / (name + ".toml")).string());
}

std::string MapFile(const std::string& folder, const Scenario& scenario) {
  return (std::filesystem::path(folder) / scenario.map).string();
}

std::string TimeLimitReason(const Scenario& scenario, const std::string& doing) {
  return fmt::format("time limit of {:.0f} s reached while: {}", scenario.time_limit_s,
                     doing.empty() ? "waiting for an answer of the planner" : doing);
}

}  // namespace priamos::cli
