#include "cli/lockstep/lockstep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "bus/lockstep.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/options/path_override.hpp"
#include "cli/report/report_files.hpp"
#include "cli/report/story_verdict.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "common/config.hpp"

namespace priamos::cli {
namespace {

/// A radio ticks so long after the full millisecond. Its messages then never have the very time of another
/// process' tick, of which a log does not tell whether it came before or after them.
constexpr Duration kRadioPhase = std::chrono::microseconds(1);

std::string TtyOf(const std::string& bus) {
  return std::string(bus == "onboard" ? kOnboardTty : kOffboardTty);
}

ConfigSource SourceOf(const LockstepRequest& request, const ScenarioProcess& process) {
  ConfigSource source{(std::filesystem::path(request.deployment) / process.config).string(), {}};
  if (!process.set.empty()) source.overrides.push_back(process.set);
  if (process.module == "head" && request.keep_pictures && request.log_folder)
    source.overrides.push_back(
        PathOverride("keep_pictures", std::filesystem::path(*request.log_folder) / "pictures"));
  if (process.module == "radio") source.overrides.push_back("port=" + TtyOf(process.bus));
  // No daemon in simulated time: the mouse is plugged into teleop itself.
  if (process.module == "teleop")
    source.overrides.insert(source.overrides.end(),
                            {"device=serial", fmt::format("spacemouse.port={}", kMouseTty)});
  return source;
}

void AddHosts(bus::Lockstep& lockstep, const bus::radio::LineConfig& line) {
  lockstep.AddBus("onboard");
  lockstep.AddBus("offboard");
  lockstep.AddSerialLine(TtyOf("onboard"), TtyOf("offboard"), line);
}

bus::Lockstep::Tap TapOf(RunRecorder& recorder, const LockstepRequest& request) {
  return [&](std::string_view bus, Time now, std::string_view channel, std::span<const std::byte> bytes) {
    recorder.OnMessage(bus, now, channel, bytes);
    if (request.tap) request.tap(bus, now, channel, bytes);
  };
}

bool RunsInSimulatedTime(const ScenarioProcess& process) {
  return process.module != "spacenavd";
}

/// Throws when nothing would make the time pass.
void RequireProcess(const LockstepRequest& request, const Scenario& scenario) {
  if (std::none_of(scenario.processes.begin(), scenario.processes.end(), RunsInSimulatedTime))
    throw ConfigError(fmt::format("scenario {}: expected a [[process]] that runs in simulated time, got none",
                                  request.scenario));
}

/// Adds the mouse's line and the processes of a scenario; no daemon runs in simulated time.
void Populate(bus::Lockstep& lockstep, const LockstepRequest& request, const Scenario& scenario) {
  if (FindStory(scenario.story).moves_mouse)
    lockstep.AddSerialLine(std::string(kMouseTty), std::string(kHandTty), {});
  for (const auto& process : scenario.processes)
    if (RunsInSimulatedTime(process))
      lockstep.AddApp(FactoryFor(process.module), process.bus, SourceOf(request, process),
                      process.module == "radio" ? kRadioPhase : Duration{});
}

/// Lets the story happen; returns how long it took [s of real time].
double RunStory(bus::Lockstep& lockstep, ScenarioStory& story, const LockstepRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  lockstep.RunUntil(Time::max(), [&] {
    if (request.interrupted()) throw Interrupted();
    story.Tick(lockstep.now());
    return story.Done(lockstep.now());
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

LockstepResult RunLockstep(const bus::Schema& schema, const LockstepRequest& request) {
  const Scenario scenario = LoadScenario(request.deployment, request.scenario);
  RequireProcess(request, scenario);
  const std::string map_file = MapFile(request.deployment, scenario);
  const auto door = LoadDoor(map_file, scenario.landmark_id, FindStory(scenario.story).seeks_door);
  bus::Lockstep lockstep(schema, {.seed = request.seed});
  AddHosts(lockstep, scenario.line);
  RunRecorder recorder(request.log_folder);
  lockstep.SetTap(TapOf(recorder, request));
  Populate(lockstep, request, scenario);

  const Time start = lockstep.now();
  std::vector<StoryLine> lines;
  const auto progress = [&](Time now, const std::string& text) {
    lines.push_back({Seconds(now - start), text});
    if (request.progress) request.progress(Time(now - start), text);
  };
  const auto story =
      FindStory(scenario.story)
          .make({scenario, request.seed, lockstep.DriverNode("onboard"), lockstep.DriverNode("offboard"),
                 [&] { return lockstep.OpenSerial(std::string(kHandTty)); }, progress});
  const double wall_s = RunStory(lockstep, *story, request);
  recorder.Flush();
  const double factor = Seconds(lockstep.now() - start) / wall_s;
  const RunInfo info{request.scenario,
                     request.seed,
                     factor,
                     door,
                     story->Reason(),
                     lines,
                     LoadTrueWorld(request.deployment, scenario, request.seed)};
  Summary summary = Summarise(recorder.record(), info);
  summary.reason = Judge(scenario, *story, summary);
  return {summary, recorder.record(), info, map_file, lockstep.now() - start};
}

}  // namespace priamos::cli
