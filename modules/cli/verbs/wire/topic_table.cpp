#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "bus/clocks/host_clock.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "bus/wire/udp_receiver.hpp"
#include "cli/terminal/silence_watch.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "cli/terminal/topic_screen.hpp"
#include "cli/terminal/topic_statistics.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "cli/verbs/wire/topic_verb.hpp"

namespace priamos::cli {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(500);
constexpr Duration kPatience = std::chrono::seconds(1);
constexpr int kNothingHeard = 1;

struct TableOptions : BusOptions {
  std::string channel;
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
int List(const TableOptions& options, const std::string& verb) {
  const bus::Schema schema = LoadTypes(options.types);
  const bus::HostClock clock;
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

void AddTableVerb(CLI::App& topic, const char* name, const char* help, bool one_channel, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
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

}  // namespace

void AddTopicTableVerbs(CLI::App& topic, int& exit_code) {
  AddTableVerb(topic, "list", "Every channel: type, rate, jitter, bandwidth, age.", false, exit_code);
  AddTableVerb(topic, "hz", "Rate and jitter of one channel.", true, exit_code);
  AddTableVerb(topic, "bw", "Bandwidth of one channel.", true, exit_code);
}

}  // namespace priamos::cli
