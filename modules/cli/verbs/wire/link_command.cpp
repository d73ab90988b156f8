#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bus/radio/budget.hpp"
#include "bus/radio/link_config.hpp"
#include "bus/schema/packing.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/supervise/link_emulate.hpp"
#include "cli/terminal/link_top.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "common/config.hpp"
#include "common/input/quoted.hpp"
#include "common/serial_port.hpp"
#include "radio/key_file.hpp"

namespace priamos::cli {
namespace {

constexpr int kDoesNotHold = 2;  ///< as for a configuration that cannot be read

nlohmann::ordered_json BitsAsJson(const bus::Packer& packer) {
  nlohmann::ordered_json json{
      {"type", packer.type().full_name}, {"max_bits", packer.MaxBits()}, {"fields", nlohmann::json::array()}};
  for (const bus::PackedField& field : packer.fields())
    json["fields"].push_back({{"name", field.name},
                              {"bits", field.bits},
                              {"values", field.values},
                              {"unit", field.unit},
                              {"outside", field.refuse ? "refused" : "nearest"},
                              {"codes", field.codes}});
  return json;
}

nlohmann::json SecondsOrNull(const std::optional<Duration>& d) {
  return d ? nlohmann::json(Seconds(*d)) : nlohmann::json();
}

nlohmann::ordered_json DirectionAsJson(const bus::radio::ChannelTable& table,
                                       const bus::radio::DirectionBudget& budget) {
  nlohmann::ordered_json json{{"bytes_per_s", budget.bytes_per_s},
                              {"capacity_bytes_per_s", budget.capacity_bytes_per_s},
                              {"utilisation", budget.utilisation},
                              {"control_bytes_per_s", budget.control_bytes_per_s},
                              {"channels", nlohmann::json::array()}};
  for (const bus::radio::ChannelBudget& c : budget.channels) {
    const bus::radio::LinkChannel& channel = table.at(c.channel);
    json["channels"].push_back(
        {{"channel", channel.name},
         {"priority", channel.priority},
         {"bits", c.bits},
         {"rate_hz", c.rate_hz},
         {"bytes_per_s", c.bytes_per_s},
         {"share", c.share},
         {"worst_latency_s", SecondsOrNull(c.worst_latency)},
         {"deadline_s",
          SecondsOrNull(channel.deadline > Duration{} ? std::optional(channel.deadline) : std::nullopt)},
         {"proven_age_s", SecondsOrNull(c.proof ? std::optional(c.proof->age()) : std::nullopt)}});
  }
  return json;
}

nlohmann::ordered_json BudgetAsJson(const bus::radio::ChannelTable& table, const bus::radio::Budget& budget) {
  nlohmann::ordered_json json{{"up", DirectionAsJson(table, budget.up)},
                              {"down", DirectionAsJson(table, budget.down)},
                              {"code_bytes", budget.code_bytes},
                              {"forgery_s", budget.forgery_s},
                              {"problems", budget.problems}};
  if (budget.robots > 0)
    json["polls"] = {{"robots", budget.robots},
                     {"cycle_s", Seconds(budget.polls.cycle)},
                     {"driven_s", Seconds(budget.polls.asked)},
                     {"cycle_beside_stops_s", SecondsOrNull(budget.polls.busy_cycle)},
                     {"driven_beside_stops_s", SecondsOrNull(budget.polls.busy_asked)},
                     {"urgent_one_s", Seconds(budget.polls.urgent_one)},
                     {"urgent_all_s", Seconds(budget.polls.urgent_all)}};
  return json;
}

void AddLineOptions(CLI::App& verb, bus::radio::LineConfig& line) {
  verb.add_option("--baud", line.baud, "10 bits per byte")
      ->check(CLI::Range(300, 1000000))
      ->capture_default_str();
  verb.add_option("--air-rate", line.air_rate_bytes_s, "byte/s of the radio itself; 0: as much as the port")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  verb.add_option("--latency", line.latency_s, "s")->check(CLI::Range(0.0, 10.0))->capture_default_str();
  verb.add_option("--jitter", line.jitter_s, "s, on top of the latency")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  verb.add_option("--bit-error-rate", line.bit_error_rate, "probability of a flip per bit")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  verb.add_option("--burst-rate", line.burst_rate_hz, "error bursts per second")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  verb.add_option("--burst-length", line.burst_length_s, "s")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  verb.add_option("--burst-error-rate", line.burst_error_rate, "probability of a flip per bit in a burst")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  verb.add_option("--duplicate", line.duplicate_probability, "probability that a byte arrives twice")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  verb.add_flag("--half-duplex", line.half_duplex, "a modem hears nothing while it sends");
  verb.add_option("--turnaround", line.turnaround_s, "s, half-duplex: nor for so long afterwards")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void AddPacketOptions(CLI::App& verb, std::optional<bus::radio::PacketAirConfig>& packets) {
  auto* flag = verb.add_flag_callback(
      "--packets", [&packets] { packets = packets.value_or(bus::radio::PacketAirConfig{}); },
      "packet radios of --air-rate instead of a line: each tty speaks KISS");
  flag->needs(verb.get_option("--air-rate"))->excludes(verb.get_option("--robots"));
  const auto option = [&](const char* name, auto bus::radio::PacketAirConfig::*member, auto range,
                          const char* text) {
    using Value = std::remove_reference_t<decltype(bus::radio::PacketAirConfig{}.*member)>;
    verb.add_option_function<Value>(
            name,
            [&packets, member](const Value& value) {
              if (!packets) packets.emplace();
              (*packets).*member = value;
            },
            text)
        ->check(range)
        ->needs(flag);
  };
  option("--packet-overhead", &bus::radio::PacketAirConfig::overhead_s, CLI::Range(0.0, 5.0),
         "s, packets: time on air beside the bytes; without it 0.02");
  option("--packet-loss", &bus::radio::PacketAirConfig::loss, CLI::Range(0.0, 1.0),
         "packets: probability that one is lost; without it 0");
  option("--mtu", &bus::radio::PacketAirConfig::mtu_bytes, CLI::Range(1, 255),
         "byte, packets: a longer one is not sent; without it 255");
}

/// An option that changes nothing makes somebody believe what is not so.
void RefuseWithoutEffect(const CLI::App& verb, const LinkEmulateOptions& options) {
  const auto refuse = [&](const std::string& option, const std::string& expected) {
    if (verb.get_option(option)->count() > 0)
      throw ConfigError(fmt::format("{}: expected {}", option, expected));
  };
  if (options.packets)
    for (const char* of_a_line : {"--baud", "--jitter", "--bit-error-rate", "--burst-rate", "--burst-length",
                                  "--burst-error-rate", "--duplicate", "--turnaround", "--delays"})
      refuse(of_a_line, "none with --packets: it is of a line");
  if (!options.line.half_duplex && options.robots == 0)
    refuse("--turnaround", "none without --half-duplex or --robots: nobody takes turns");
  if (options.line.burst_rate_hz <= 0)
    for (const char* of_bursts : {"--burst-length", "--burst-error-rate"})
      refuse(of_bursts, "none without --burst-rate: there are no bursts");
  if (options.a == options.b)
    throw ConfigError(fmt::format("--b: expected another name than that of --a, got {}", Quoted(options.b)));
}

void AddEmulate(CLI::App& link, int& exit_code) {
  auto options = std::make_shared<LinkEmulateOptions>();
  auto* verb = AddVerb(link, "emulate", "A pair of radio modems: two ttys joined by an emulated line.");
  verb->footer("Example: priamos link emulate --a /tmp/tty-robot --b /tmp/tty-desk --bit-error-rate 1e-4");
  verb->add_option("--a", options->a, "name of the first tty")->capture_default_str();
  verb->add_option("--b", options->b, "name of the second tty")->capture_default_str();
  verb->add_option("--robots", options->robots,
                   "a half-duplex channel that so many robots share: --a is the station, --b gives the names "
                   "of theirs, B-1, B-2, ...")
      ->check(CLI::Range(1, 8));
  AddLineOptions(*verb, options->line);
  AddPacketOptions(*verb, options->packets);
  verb->add_option("--blackouts", options->blackouts,
                   "CSV file with from_s,to_s per line: no line in between");
  verb->add_option("--delays", options->delays,
                   "CSV file with way,from_s,to_s,first_s,last_s per line: more delay of one way for a time");
  verb->add_option("--seed", options->seed, "seed of the errors")->capture_default_str();
  verb->add_flag("--json", options->json, "print the ttys as JSON");
  verb->callback([options, verb, &exit_code] {
    RefuseWithoutEffect(*verb, *options);
    exit_code = RunLinkEmulate(*options);
  });
}

void AddKeygen(CLI::App& link, int& exit_code) {
  auto path = std::make_shared<std::string>();
  auto* verb = AddVerb(link, "keygen", "Make a secret key for a radio link; both ends need the same file.");
  verb->footer("Example: priamos link keygen /etc/priamos/link.key");
  verb->add_option("file", *path, "where to; an existing file is kept")->required();
  auto json = std::make_shared<bool>(false);
  verb->add_flag("--json", *json, "machine-readable");
  verb->callback([=, &exit_code] {
    radio::WriteNewKeyFile(*path);
    if (*json) std::cout << nlohmann::ordered_json{{"file", *path}}.dump() << "\n";
    if (!*json)
      std::cout << *path << ": new key; copy it to the other end over a secure channel, mode 0600\n";
    exit_code = 0;
  });
}

constexpr const char* kRekeySteps =
    "{0}: next key of {1}. Next:\n"
    "  1. copy it over a secure channel beside the key of the other machine, under the name of that key and\n"
    "     .next, with the same owner and mode\n"
    "  2. start one priamos-radio again, then the other: the link changes the key without a pause\n"
    "  3. when both say that the link uses the next key, on each machine: priamos link rekey --finish {1}\n";

void AddRekey(CLI::App& link, int& exit_code) {
  auto path = std::make_shared<std::string>();
  auto* verb = AddVerb(link, "rekey",
                       "Change the key of a running radio link: make the next one, or put it in place.");
  verb->footer("Example: priamos link rekey /etc/priamos/link.key");
  verb->add_option("file", *path, "the key in use; the next one is in FILE.next")->required();
  auto finish = std::make_shared<bool>(false), json = std::make_shared<bool>(false);
  verb->add_flag("--finish", *finish, "FILE.next replaces FILE");
  verb->add_flag("--json", *json, "machine-readable");
  verb->callback([=, &exit_code] {
    const std::string made = *finish ? *path : radio::NextKeyFile(*path);
    if (*finish) radio::FinishKeyChange(*path);
    if (!*finish) radio::WriteNextKeyFile(*path);
    if (*json)
      std::cout << nlohmann::ordered_json{{"file", made}}.dump() << "\n";
    else if (*finish)
      std::cout << *path << ": is the key that was the next one; the one before is gone\n";
    else
      std::cout << fmt::format(kRekeySteps, made, *path);
    exit_code = 0;
  });
}

void AddBits(CLI::App& link, int& exit_code) {
  auto type = std::make_shared<std::string>();
  auto types = std::make_shared<std::vector<std::string>>();
  auto* verb = AddVerb(link, "bits", "How many bits a message takes on the radio, field by field.");
  verb->footer("Example: priamos link bits pose_t");
  verb->add_option("type", *type, "message type")->required();
  AddTypesOption(*verb, *types);
  auto json = std::make_shared<bool>(false);
  verb->add_flag("--json", *json, "machine-readable");
  verb->callback([=, &exit_code] {
    const bus::Schema schema = LoadTypes(*types);
    const bus::Struct* found = schema.Find(*type);
    if (found == nullptr) throw UnknownType(schema, *type);
    const bus::Packer packer(*found);
    std::cout << (*json ? BitsAsJson(packer).dump(2) + "\n" : bus::FormatBitTable(packer));
    exit_code = 0;
  });
}

/// link.toml does not say what the port is: over TCP and on simulated time any rate is one.
std::string RateHint(const bus::radio::LinkConfig& link) {
  const std::string problem = link.datagrams ? "" : SerialRateProblem(link.baud);
  if (problem.empty()) return {};
  return fmt::format("priamos link budget: {}: with a tty as port: {}; over TCP it holds\n",
                     link.place.Of("baud"), problem);
}

void AddBudget(CLI::App& link, int& exit_code) {
  auto config = std::make_shared<std::string>();
  auto types = std::make_shared<std::vector<std::string>>();
  auto* verb =
      AddVerb(link, "budget", "What a link.toml asks of the line: bytes, shares, worst-case latencies.");
  verb->footer("Example: priamos link budget config/sim/link.toml");
  verb->add_option("config", *config, "link.toml")->required();
  AddTypesOption(*verb, *types);
  auto json = std::make_shared<bool>(false);
  verb->add_flag("--json", *json, "machine-readable");
  verb->callback([=, &exit_code] {
    const auto link_config = LoadConfig<bus::radio::LinkConfig>(*config);
    const bus::Schema schema = LoadTypes(*types);
    const auto table = link_config.Table(schema);
    const auto budget = ComputeBudget(table, link_config.Options());
    std::cout << (*json ? BudgetAsJson(table, budget).dump(2) + "\n" : FormatBudget(table, budget));
    std::cerr << RateHint(link_config);
    for (const std::string& problem : budget.problems)
      std::cerr << "priamos link budget: " << problem << "\n";
    exit_code = budget.problems.empty() ? 0 : kDoesNotHold;
  });
}

void AddTop(CLI::App& link, int& exit_code) {
  auto options = std::make_shared<LinkTopOptions>();
  auto* verb = AddVerb(link, "top", "The link as it is now: load, quality, every channel.");
  verb->footer("Example: priamos link top --bus onboard");
  bus::AddBusChoice(*verb, options->bus.bus);
  verb->add_flag("--once", options->once, "one screen, then end");
  verb->add_flag("--json", options->json, "machine-readable, one line instead of a screen");
  verb->callback([options, &exit_code] { exit_code = RunLinkTop(*options); });
}

void AddListen(CLI::App& link, int& exit_code) {
  auto options = std::make_shared<LinkTopOptions>();
  auto* verb = AddVerb(link, "listen", "Have an on-request channel sent over the radio while this runs.");
  verb->footer("Example: priamos link listen SONAR_RANGES --for 10");
  verb->add_option("channel", options->channel, "LCM channel of the other side")->required();
  verb->add_option("--for", options->seconds, "s; 0: until Ctrl-C")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  bus::AddBusChoice(*verb, options->bus.bus);
  verb->callback([options, &exit_code] { exit_code = RunLinkListen(*options); });
}

}  // namespace

void AddLinkCommand(CLI::App& cli, int& exit_code) {
  auto* link =
      AddVerb(cli, "link", "The radio link: emulate one, make keys, see what it costs and what it does.");
  link->require_subcommand(1);
  AddEmulate(*link, exit_code);
  AddKeygen(*link, exit_code);
  AddRekey(*link, exit_code);
  AddBits(*link, exit_code);
  AddBudget(*link, exit_code);
  AddLinkTableVerb(*link);
  AddTop(*link, exit_code);
  AddListen(*link, exit_code);
}

}  // namespace priamos::cli
