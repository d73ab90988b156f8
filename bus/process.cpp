#include "bus/process.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "bus/app_host.hpp"
#include "bus/claim_keeper.hpp"
#include "bus/claim_messages.hpp"
#include "bus/clocks/clock_exchange.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/clocks/live_messages.hpp"
#include "bus/command_line.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/log_follower.hpp"
#include "bus/other_bus.hpp"
#include "bus/own_types.hpp"
#include "bus/probe_answerer.hpp"
#include "bus/process_config.hpp"
#include "bus/process_options.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/replay.hpp"
#include "bus/schema/schema.hpp"
#include "bus/wire/multicast.hpp"
#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "common/serial_port.hpp"

namespace priamos::bus {
namespace {

constexpr int kFailedWhileRunning = 1;
constexpr std::string_view kFileUrl = "file://";

using Options = ProcessOptions;

/// Returns the exit code when the command line was answered or refused.
std::optional<int> ParseCommandLine(const AppFactory& factory, int argc, char** argv, Options& options) {
  CLI::App cli(factory.summary, "priamos-" + factory.name);
  AddProcessOptions(cli, factory, options);
  return bus::ParseCommandLine(cli, argc, argv);
}

std::function<void(Level, std::string_view)> MakeLog(const std::string& name) {
  auto logger =
      std::make_shared<spdlog::logger>(name, std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_pattern("%H:%M:%S.%e %n: %v");
  return [logger](Level level, std::string_view text) {
    constexpr spdlog::level::level_enum kLevels[] = {spdlog::level::info, spdlog::level::warn,
                                                     spdlog::level::err};
    logger->log(kLevels[static_cast<int>(level)], "{}", text);
  };
}

/// Two buses on one machine differ in their address, or in the network namespace they live in.
std::string InstanceOf(const std::string& bus) {
  struct stat network {};
  stat("/proc/self/ns/net", &network);
  return fmt::format("{}-{}-{}", GroupOf(bus), PortOf(bus), network.st_ino);
}

Surroundings MakeSurroundings(const AppFactory& factory, const Options& options, std::int32_t claimant = 0) {
  Surroundings around;
  around.claimant = claimant;
  around.instance = InstanceOf(options.bus);
  around.robot = options.choice.robot;
  around.config_dir = options.config.Folder();
  around.seed = options.seed;
  around.log = MakeLog(factory.name);
  around.open_serial = [](const std::string& path, int baud) { return OpenSerialPort(path, baud); };
  return around;
}

/// --interface starts the App without its hardware.
class UnconnectedPort : public ByteStream {
 public:
  std::size_t Read(std::span<std::byte>) override { return 0; }
  std::size_t Write(std::span<const std::byte> bytes) override { return bytes.size(); }
};

int PrintInterface(const AppFactory& factory, const Options& options) {
  const Schema schema = OwnTypes(factory.types);
  LcmBus bus("memq://");
  const HostClock clock;
  auto around = MakeSurroundings(factory, options);
  around.open_serial = [](const std::string&, int) { return std::make_unique<UnconnectedPort>(); };
  around.instance = "interface";
  around.open_bus = [&](const std::string&) { return std::make_unique<OtherBus>("memq://", schema, clock); };
  const AppHost host(factory, options.config, bus, schema, clock, std::move(around));
  for (const auto& e : host.node().inputs()) std::cout << fmt::format("in   {:<18} {}\n", e.channel, e.type);
  for (const auto& e : host.node().outputs()) std::cout << fmt::format("out  {:<18} {}\n", e.channel, e.type);
  return 0;
}

/// Runs the App from a log, `file://LOG[?out=LOG2]`: it gets what the log holds at the log's own times, as
/// fast as it can.
int RunFromLog(const AppFactory& factory, const Options& options) {
  const std::string rest = options.bus.substr(kFileUrl.size());
  const auto question = rest.find('?');
  const std::string query = question == std::string::npos ? "" : rest.substr(question + 1);
  if (!query.empty() && (!query.starts_with("out=") || query.size() == 4))
    throw BusError(
        fmt::format("bus {}: expected file://LOG or file://LOG?out=LOG, got \"?{}\"", options.bus, query));
  std::optional<LogWriter> out;
  if (!query.empty()) out.emplace(query.substr(4));
  const Schema schema = OwnTypes(factory.types);
  Replay replay(factory, options.config, schema, rest.substr(0, question),
                {options.config.Folder(), options.seed, MakeLog(factory.name)});
  std::uint64_t sent = 0;
  replay.Run([&](const Output& output) {
    ++sent;
    if (out) out->Write(output.utime, output.channel, output.bytes);
  });
  std::cout << replay.Summary(sent) << '\n';
  if (out) out->Flush();
  return out && !out->good() ? kFailedWhileRunning : 0;
}

/// Runs the App on a log that is being played onto the bus.
int FollowLog(const AppFactory& factory, const Options& options, const LogShow& show) {
  if (!options.bus.starts_with("udpm://"))
    throw BusError(
        fmt::format("--clock bus: expected a bus onto which a log is played (udpm://), got {}", options.bus));
  const SignalWatch signals;
  const Schema schema = OwnTypes(factory.types);
  const auto log = MakeLog(factory.name);
  LcmBus bus(options.bus);
  const HostClock alive;
  LiveMessages live(schema, [&log](const std::string& sentence) { log(Level::kInfo, sentence); });
  bus.TranslateBy([&](std::uint64_t sender, std::string_view channel, std::span<const std::byte> bytes) {
    return live.IsLive(sender, channel, bytes, alive.Now()) ? std::nullopt : std::optional(bytes);
  });
  if (show) return show({bus, schema, options.config, signals, log});
  const auto start = [&](const Clock& clock) {
    log(Level::kInfo,
        fmt::format("time is that of {}; what this sends goes to {}...", bus.url(), LogFollower::kPrefix));
    Surroundings around = MakeSurroundings(factory, options);
    around.from_log = true;
    return std::make_unique<AppHost>(factory, options.config, bus, schema, clock, std::move(around));
  };
  for (std::vector<HeardMessage> first;;) {
    LogFollower follower(bus, schema, factory.name, start, std::move(first));
    const auto warn = [&log](const std::string& problem) { log(Level::kWarning, problem); };
    if (const auto code = follower.Run(signals, warn)) return *code;
    log(Level::kInfo, "the log went back: beginning anew");
    first = follower.TakeBeginning();
  }
}

/// Reports a configuration that cannot be used before the role is claimed.
void RequireConfiguration(const AppFactory& factory, const ConfigSource& source) {
  std::ostream nowhere(nullptr);
  factory.print_config(nowhere, source);
}

/// Before the App is made: making it may already take what belongs to the owner, a port or a frame store.
std::unique_ptr<ClaimKeeper> ClaimRole(const AppFactory& factory, LcmBus& bus, const Schema& schema,
                                       const Clock& clock, const Claimant& self) {
  if (!factory.one_owner || !bus.url().starts_with("udpm://")) return nullptr;
  return std::make_unique<ClaimKeeper>(bus, schema, clock, self, ClaimTerms{factory.speaks_alone},
                                       MakeLog(factory.name));
}

/// The keys of the App, and the bus as it was chosen: what it would use.
int PrintConfiguration(const AppFactory& factory, const Options& options) {
  factory.print_config(std::cout, options.config);
  BusChoice choice = options.choice;
  DescribeBus(*MakeConfigPrinter(std::cout), choice);
  return 0;
}

/// What a person should know of clock and bus before the process begins.
void WarnOf(const AppFactory& factory, const std::string& url, const ClockAnchor& anchor) {
  const auto log = MakeLog(factory.name);
  if (!anchor.problem.empty())
    log(Level::kWarning,
        "clock: " + anchor.problem +
            "; until that is mended, a wall clock that is set between the starts of two processes "
            "separates their stamps");
  if (url.starts_with("udpm://") && GroupOf(url) == kLcmDefaultGroup && PortOf(url) == kLcmDefaultPort)
    log(Level::kWarning,
        fmt::format("bus {}: every LCM program that was told no address uses this one: they hear this "
                    "process, and can command it; next: --bus onboard or offboard, with a name "
                    "by --robot",
                    url));
}

int Run(const AppFactory& factory, const Options& options, const LogShow& show, bool& running) {
  if (options.print_config) return PrintConfiguration(factory, options);
  if (options.print_parameters) {
    std::cout << ToJson(factory.parameters(options.config)) << '\n';
    return 0;
  }
  if (options.interface) return PrintInterface(factory, options);
  if (options.bus.starts_with(kFileUrl)) return RunFromLog(factory, options);
  RequireConfiguration(factory, options.config);
  if (options.follows_log) return FollowLog(factory, options, show);
  const SignalWatch signals;
  const Schema schema = OwnTypes(factory.types);
  const HostClock clock;
  WarnOf(factory, options.bus, clock.anchor());
  LcmBus bus(options.bus);
  const ProbeAnswerer answerer(bus, schema, clock, factory.name);
  const auto clocks = ExchangeWhereNeeded(bus, schema, clock);
  const Claimant self = MakeClaimant(options.choice.robot, factory.name);
  const auto claim = ClaimRole(factory, bus, schema, clock, self);
  Surroundings around = MakeSurroundings(factory, options, self.instance);
  around.open_bus = [&](const std::string& robot) {
    BusChoice choice = options.choice;
    choice.bus = "offboard";
    choice.robot = robot;
    return std::make_unique<OtherBus>(choice.Url(), schema, clock);
  };
  AppHost host(factory, options.config, bus, schema, clock, std::move(around));
  if (clocks) {
    host.ReportProblemsOf([&] { return clocks->Problems(clock.Now()); });
    host.ReportClockOf([&] { return clocks->AheadOfReference(clock.Now()); });
  }
  running = true;
  return RunRealTime(host, bus, clock, signals, {claim.get(), clocks.get()});
}

}  // namespace

int RunProcess(const AppFactory& factory, int argc, char** argv, const LogShow& show) {
  Options options;
  if (const auto code = ParseCommandLine(factory, argc, argv, options)) return *code;
  bool running = false;
  try {
    ChooseBus(factory, options);
    return Run(factory, options, show, running);
  } catch (const std::exception& error) {
    std::cerr << "priamos-" << factory.name << ": " << error.what() << "\n";
    return running ? kFailedWhileRunning : kCannotStart;
  }
}

}  // namespace priamos::bus
