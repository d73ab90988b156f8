#include "console/played_log.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "bus/clocks/host_clock.hpp"
#include "bus/host/service_notifier.hpp"
#include "bus/process_config.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "common/config.hpp"
#include "common/ground_plan.hpp"
#include "console/console_config.hpp"
#include "console/greeting.hpp"
#include "console/log_on_bus.hpp"
#include "console/replay_station.hpp"
#include "console/server_options.hpp"

namespace priamos::console {
namespace {

constexpr int kPeriod_ms = 5;

}  // namespace

int ShowPlayedLog(const bus::PlayedLog& log) {
  const auto config = bus::LoadAppConfig<ConsoleConfig>(log.config);
  const std::filesystem::path folder = log.config.Folder();
  const auto plan = LoadConfig<GroundPlan>((folder / config.map).string());
  const auto link = LoadConfig<bus::radio::LinkConfig>((folder / config.link).string());
  const auto in_folder = [&folder](const std::string& file) { return (folder / file).string(); };
  const bus::HostClock clock;
  bus::ServiceNotifier notifier;
  ReplayStation station(std::make_unique<LogOnBus>(log.bus, log.schema), log.schema, plan,
                        Greeting(config, plan, link, std::numeric_limits<double>::infinity()),
                        ServerOptionsOf(config, in_folder));
  const std::string status = fmt::format("the log on {} is shown at {}", log.bus.url(), station.address());
  log.report(bus::Level::kInfo, status);
  while (!log.signals.Came(kPeriod_ms)) {
    station.Tick(clock.Now());
    notifier.Beat(clock.Now(), status);
  }
  return 0;
}

}  // namespace priamos::console
