#include <fmt/format.h>
#include <poll.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "bus/real_time_loop.hpp"
#include "bus/schema/json.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/udp_receiver.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/silence_watch.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "cli/terminal/topic_echo.hpp"
#include "cli/terminal/topic_screen.hpp"
#include "cli/terminal/topic_statistics.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "common/nearest_word.hpp"

namespace priamos::cli {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(500);
constexpr Duration kPatience = std::chrono::seconds(1);
constexpr int kNothingHeard = 1;

struct TopicOptions : BusOptions {
  std::string channel;
  std::string type;
  std::string message;
  double seconds = 2;
  bool json = false;
  bool watch = false;
};

/// Handles messages until `until` or a signal; calls `each` after every poll, 20 times a second at least.
void Listen(bus::LcmBus& bus, const bus::Clock& clock, Time until, const std::function<void(Time)>& each) {
  const bus::SignalWatch signals;
  while (clock.Now() < until) {
    pollfd fds[] = {{bus.fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}};
    poll(fds, std::size(fds), 50);
    if (fds[1].revents != 0) return;
    bus.Drain();
    each(clock.Now());
  }
}

nlohmann::ordered_json ToJson(const TopicRow& row) {
  return {{"channel", row.channel},
          {"type", row.type},
          {"messages", row.messages},
          {"undecodable", row.undecodable},
          {"rate_hz", row.rate_hz},
          {"jitter_s", row.jitter_s},
          {"bytes_per_s", row.bandwidth_bytes_s},
          {"age_s", row.age_s},
          {"largest_bytes", row.largest_bytes}};
}

void PrintJson(const std::vector<TopicRow>& rows, const bus::LcmBus& bus) {
  auto all = nlohmann::ordered_json::array();
  for (const auto& row : rows) all.push_back(ToJson(row));
  auto senders = nlohmann::ordered_json::array();
  for (const auto& s : bus.senders())
    senders.push_back(
        {{"address", bus::SenderAddress(s.sender)}, {"datagrams", s.datagrams}, {"lost", s.lost}});
  std::cout << nlohmann::ordered_json{{"senders", senders},
                                      {"lost", bus.lost()},
                                      {"malformed", bus.malformed()},
                                      {"turned_away", bus.turned_away()},
                                      {"channels", all}}
                   .dump()
            << std::endl;
}

/// Verb `list`, and with a channel `hz` and `bw`: a table of all channels or of one.
int List(const TopicOptions& options, const std::string& verb) {
  const bus::Schema schema = LoadTypes(options);
  const bus::MonotonicClock clock;
  bus::LcmBus bus(options.bus.Url(), options.messages());
  TopicStatistics statistics(schema, FromSeconds(std::max(2.0, options.seconds)));
  // With a time limit the sentence comes at the end, once.
  const Duration patience = options.watch ? kPatience : FromSeconds(options.seconds) + kPatience;
  SilenceWatch silence("priamos topic " + verb, options, options.channel, clock.Now(), patience);
  const auto add = [&](std::string_view channel, std::span<const std::byte> bytes) {
    statistics.Add(clock.Now(), channel, bytes);
    silence.Heard();
  };
  options.channel.empty() ? bus.SubscribeEverything(add) : bus.Subscribe(options.channel, add);
  const auto losses = [&] {
    return BusLosses{bus.senders(), bus.lost(), bus.malformed(), bus.turned_away()};
  };
  const Time until = options.watch ? Time::max() : clock.Now() + FromSeconds(options.seconds);
  std::optional<TerminalScreen> screen(std::in_place);
  Listen(bus, clock, until, [&](Time now) {
    silence.Step(now);
    // Before the first message the terminal belongs to the sentence of `silence`.
    if (!options.watch || statistics.empty() || !screen->Due(now, kWatchPeriod)) return;
    if (options.json) return PrintJson(statistics.Rows(now), bus);
    screen->Show(TopicScreen(statistics.Rows(now), losses(), screen->size()));
  });
  screen.reset();
  const auto rows = statistics.Rows(clock.Now());
  if (!options.watch && options.json) PrintJson(rows, bus);
  if (!options.watch && !options.json) std::cout << TopicScreen(rows, losses(), TableSize()) << std::flush;
  silence.Explain(clock.Now());
  return rows.empty() ? kNothingHeard : 0;
}

bus::Json ParseMessage(const std::string& text) {
  try {
    return bus::Json::parse(text);
  } catch (const bus::Json::out_of_range&) {
    throw bus::MessageError(
        fmt::format("message: expected numbers of at most 1.8e308, got one out of range in {}", text));
  } catch (const bus::Json::parse_error&) {
    throw bus::MessageError(fmt::format("message: expected JSON, got {}", text));
  }
}

/// What is sent all the same, but probably to nobody: a channel that PRIAMOS does not have.
void WarnOfUnknownChannel(const TopicOptions& options, const std::string& channel) {
  const auto known = ChannelNames(false);
  if (!options.types.empty() || std::find(known.begin(), known.end(), channel) != known.end()) return;
  std::cerr << fmt::format(
      "priamos topic pub: \"{}\" is no channel of PRIAMOS{} (priamos type channels lists all)\n", channel,
      NearestText(channel, known));
}

int Pub(const TopicOptions& options) {
  const bus::Schema schema = LoadTypes(options);
  const auto* type = schema.Find(options.type);
  if (!type) throw UnknownType(schema, options.type);
  bus::LcmBus bus(options.bus.Url(), options.messages());
  const auto message = ParseMessage(options.message);
  const auto bytes = bus::FromJson(*type, message);
  if (!bus.Publish(options.channel, bytes))
    throw bus::BusError(fmt::format("{}: {} bytes were not sent", options.bus.Url(), bytes.size()));
  WarnOfUnknownChannel(options, options.channel);
  if (type->name == "link_request_t" && message.at("channel").is_string())
    WarnOfUnknownChannel(options, message.at("channel").get<std::string>());
  if (options.json)
    std::cout << nlohmann::ordered_json{{"channel", options.channel}, {"bytes", bytes.size()}} << "\n";
  return 0;
}

int PrintUrl(const TopicOptions& options) {
  const std::string url = options.bus.Url();
  std::cout << (options.json ? nlohmann::ordered_json{{"url", url}}.dump() : url) << "\n";
  return 0;
}

/// Adds a verb of `topic`. `options` are the verb's own: CLI11 fills in what $PRIAMOS_BUS says for every verb
/// that was not typed, and would overwrite the --bus of the one that was.
CLI::App* AddTopicVerb(CLI::App& topic, const char* name, const char* help, const char* example,
                       TopicOptions& options) {
  auto* verb = AddVerb(topic, name, help);
  verb->footer(std::string("Example: ") + example);
  AddBusOption(*verb, options);
  AddTypesOption(*verb, options);
  return verb;
}

void AddTableVerb(CLI::App& topic, const char* name, const char* help, bool one_channel, int& exit_code) {
  auto options = std::make_shared<TopicOptions>();
  const std::string example = fmt::format("priamos topic {} {}", name, one_channel ? "POSE" : "--watch");
  auto* verb = AddTopicVerb(topic, name, help, example.c_str(), *options);
  if (one_channel) AddChannelArgument(*verb, options->channel);
  verb->add_option("--seconds", options->seconds, "how long to listen")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  verb->add_flag("--watch", options->watch, "a live table, until Ctrl-C");
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code, name] { exit_code = List(*options, name); });
}

void AddUrlVerb(CLI::App& topic, int& exit_code) {
  auto options = std::make_shared<TopicOptions>();
  auto* verb = AddTopicVerb(topic, "url", "Print the URL of a bus, for LCM's own programs.",
                            "priamos topic url --bus onboard", *options);
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code] { exit_code = PrintUrl(*options); });
}

void AddPubVerb(CLI::App& topic, int& exit_code) {
  auto options = std::make_shared<TopicOptions>();
  auto* verb = AddTopicVerb(topic, "pub", "Send one message, given as JSON.",
                            "priamos topic pub LINK_REQUEST link_request_t "
                            "'{\"utime\":0,\"channel\":\"SONAR_RANGES\",\"hold_s\":5}'",
                            *options);
  AddChannelArgument(*verb, options->channel);
  verb->add_option("type", options->type, "message type")->required();
  verb->add_option("message", options->message, "the message as JSON")->required();
  verb->add_flag("--json", options->json, "print what was sent as JSON");
  verb->callback([options, &exit_code] { exit_code = Pub(*options); });
}

}  // namespace

void AddTopicCommand(CLI::App& cli, int& exit_code) {
  auto* topic = AddVerb(cli, "topic", "See and send what is on a bus, of any type, without compiling it.");
  topic->require_subcommand(1);
  AddTableVerb(*topic, "list", "Every channel: type, rate, jitter, bandwidth, age.", false, exit_code);
  AddTableVerb(*topic, "hz", "Rate and jitter of one channel.", true, exit_code);
  AddTableVerb(*topic, "bw", "Bandwidth of one channel.", true, exit_code);
  AddTopicEchoVerb(*topic, exit_code);
  AddUrlVerb(*topic, exit_code);
  AddPubVerb(*topic, exit_code);
}

}  // namespace priamos::cli
