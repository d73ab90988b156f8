#include "cli/front/estop_command.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "bus/bus_choice.hpp"
#include "bus/clocks/clock_exchange.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/front/estop_silence.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr Duration kAgain = std::chrono::seconds(1);
constexpr int kNoAnswer = 1;

struct EstopOptions {
  bus::BusChoice bus;
  bool rearm = false, json = false;
  double wait_s = 5;
};

/// Prints the result; `after` is none when nobody answered, then `why` is the hint. JSON is written by hand,
/// for the e-stop links few libraries.
int Report(const EstopOptions& options, std::optional<Duration> after, const std::string& why = "") {
  if (options.json)
    std::cout << fmt::format("{{\"action\":\"{}\",\"confirmed\":{},\"after_s\":{}}}\n",
                             options.rearm ? "REARM" : "STOP", after.has_value(),
                             after ? fmt::format("{:.3f}", Seconds(*after)) : "null");
  if (!after) {
    std::cerr << fmt::format("priamos estop: the robot did not answer within {:g} s on {} ({}); {}\n",
                             options.wait_s, options.bus.bus, options.bus.Url(), why);
    return kNoAnswer;
  }
  if (!options.json)
    std::cout << fmt::format("{} after {:.2f} s\n", options.rearm ? "re-armed" : "e-stop is latched",
                             Seconds(*after));
  return 0;
}

/// Sends the order at once, and again until the robot's status shows its effect.
int Run(const EstopOptions& options) {
  const bus::Schema schema = bus::OwnTypes();
  const bus::HostClock clock;
  bus::LcmBus bus(options.bus.Url());
  const auto clocks = bus::ExchangeWhereNeeded(bus, schema, clock);
  bus::Node node(bus, schema, clock);
  auto estop = node.Advertise(channels::kEstop);
  const auto status = node.Subscribe(channels::kDriveStatus);
  const Time begin = clock.Now();
  std::optional<EstopSilence> silence;
  for (Time sent = begin - kAgain; clock.Now() - begin < FromSeconds(options.wait_s);) {
    if (clock.Now() - sent >= kAgain) {
      sent = clock.Now();
      estop_t message{};
      message.utime = ToUtime(sent);
      message.action = options.rearm ? estop_t::REARM : estop_t::STOP;
      message.driver = lease_request_t::CONSOLE;
      estop.Publish(message);
    }
    pollfd fd{bus.fd(), POLLIN, 0};
    poll(&fd, 1, 20);
    bus.Drain();
    if (clocks) clocks->Tick(clock.Now());
    // A status from before the order proves nothing.
    if (status.get() && FromUtime(status.get()->utime) > begin && bool(status.get()->estop) != options.rearm)
      return Report(options, clock.Now() - begin);
    // Not before the order has been sent.
    if (!silence) silence.emplace(options.bus);
    silence->Drain();
  }
  return Report(options, std::nullopt, silence ? silence->Why() : "");
}

}  // namespace

void AddEstopCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<EstopOptions>();
  auto* verb =
      cli.add_subcommand("estop", "Emergency stop: the wheels stop and stay stopped until re-arming.");
  verb->footer("Example: priamos estop; later priamos estop --rearm");
  bus::AddBusChoice(*verb, options->bus);
  verb->add_flag("--rearm", options->rearm, "lift it; nothing moves without a new command");
  verb->add_flag("--json", options->json, "machine-readable");
  verb->add_option("--wait", options->wait_s, "s, for the robot's answer")
      ->check(CLI::Range(0.1, 600.0))
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace priamos::cli
