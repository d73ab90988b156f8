#include "cli/lockstep_run.hpp"

#include <chrono>
#include <filesystem>

#include "bus/lockstep.hpp"
#include "cli/factories.hpp"
#include "cli/report_files.hpp"
#include "cli/scenario_driver.hpp"

namespace priamos::cli {
namespace {

std::string TtyOf(const std::string& bus) {
  return std::string(bus == "onboard" ? kOnboardTty : kOffboardTty);
}

ConfigSource SourceOf(const LockstepRequest& request, const ScenarioProcess& process) {
  ConfigSource source{(std::filesystem::path(request.deployment) / process.config).string(), {}};
  if (!process.set.empty()) source.overrides.push_back(process.set);
  if (process.module == "radio") source.overrides.push_back("port=" + TtyOf(process.bus));
  return source;
}

}  // namespace

LockstepResult RunLockstep(const bus::Schema& schema, const LockstepRequest& request) {
  const Scenario scenario = LoadScenario(request.deployment, request.scenario);
  const std::string map_file = MapFile(request.deployment, scenario);
  const DoorPlan door = LoadDoor(map_file, scenario.landmark_id);
  bus::Lockstep lockstep(schema, {.seed = request.seed});
  lockstep.AddBus("onboard");
  lockstep.AddBus("offboard");
  lockstep.AddSerialLine(TtyOf("onboard"), TtyOf("offboard"), scenario.line);
  RunRecorder recorder(request.log_folder);
  lockstep.SetTap(
      [&](std::string_view bus, Time now, std::string_view channel, std::span<const std::byte> bytes) {
        recorder.OnMessage(bus, now, channel, bytes);
        if (request.tap) request.tap(bus, now, channel, bytes);
      });
  for (const auto& process : scenario.processes)
    lockstep.AddApp(FactoryFor(process.module), process.bus, SourceOf(request, process));

  const Time start = lockstep.now();
  ScenarioDriver driver(scenario, lockstep.DriverNode("onboard"), lockstep.DriverNode("offboard"),
                        [&](Time now, const std::string& text) {
                          if (request.progress) request.progress(Time(now - start), text);
                        });
  const auto wall_start = std::chrono::steady_clock::now();
  lockstep.RunUntil(Time::max(), [&] {
    driver.Tick(lockstep.now());
    return driver.Done(lockstep.now());
  });
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  recorder.Flush();
  const double factor = Seconds(lockstep.now() - start) / wall_s;
  const RunInfo info{request.scenario, request.seed, factor, door};
  return {Summarise(recorder.record(), info), recorder.record(), info, map_file, driver.Reason()};
}

}  // namespace priamos::cli
