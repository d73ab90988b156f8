#include "bus/process_options.hpp"

#include <CLI/CLI.hpp>

#include "bus/process_config.hpp"

namespace priamos::bus {
namespace {

void AddAlias(CLI::App& cli, const OptionAlias& alias, ConfigSource& config) {
  const std::string flag(alias.flag), key(alias.key), value(alias.value), doc(alias.doc);
  if (value.empty()) {
    cli.add_option_function<std::string>(
        flag, [&config, key](const std::string& text) { config.overrides.push_back(key + "=" + text); }, doc);
  } else {
    cli.add_flag_callback(
        flag, [&config, key, value] { config.overrides.push_back(key + " = " + value); }, doc);
  }
}

}  // namespace

void AddProcessOptions(CLI::App& cli, const AppFactory& factory, ProcessOptions& options) {
  cli.add_option("--config", options.config.path, "TOML file; without it every key keeps its default");
  cli.add_option("--set", options.config.overrides, "KEY=VALUE on top of the file");
  cli.add_option("--saved", options.config.saved,
                 "file of parameters that were saved while it ran (priamos param), on top of everything; "
                 "without it none can be saved");
  options.choice.bus = factory.default_bus;
  AddBusChoice(cli, options.choice);
  cli.get_option("--bus")->description(
      "LCM bus: onboard, offboard or an LCM URL; file://LOG[?out=LOG] runs from a log");
  cli.add_option("--seed", options.seed, "seed of simulated hardware")->capture_default_str();
  cli.add_flag("--print-config", options.print_config,
               "print every key with value, unit and meaning, and exit");
  cli.add_flag("--print-parameters", options.print_parameters,
               "print what may be changed while it runs, as JSON, and exit");
  cli.add_flag("--interface", options.interface, "print the channels read and written, and exit");
  if (factory.follows_logs)
    cli.add_option_function<std::string>(
           "--clock", [&options](const std::string& clock) { options.follows_log = clock == "bus"; },
           "host; or bus: time is that of the newest message, for a log that is played onto the bus; what it "
           "sends "
           "goes to REPLAYED_...")
        ->check(CLI::IsMember({"host", "bus"}))
        ->default_str("host");
  for (const auto& alias : factory.aliases) AddAlias(cli, alias, options.config);
  cli.parse_complete_callback([&cli, &options] {
    for (const char* name : {"--bus", "--robot", "--ttl", "--network"})
      if (!cli.get_option(name)->empty()) options.typed.emplace_back(name);
  });
}

void ChooseBus(const AppFactory& factory, ProcessOptions& options) {
  BusChoice choice;
  choice.bus = factory.default_bus;
  choice = LoadBusChoice(options.config, choice);
  for (const std::string& name : options.typed) {
    if (name == "--bus") choice.bus = options.choice.bus;
    if (name == "--robot") choice.robot = options.choice.robot;
    if (name == "--ttl") choice.ttl = options.choice.ttl;
    if (name == "--network") choice.network = options.choice.network;
  }
  options.choice = choice;
  options.bus = choice.Url();
}

}  // namespace priamos::bus
