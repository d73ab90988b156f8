#include <fmt/format.h>
#include <poll.h>

#include <iostream>
#include <string>

#include "bus/clocks/host_clock.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/schema/walk.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "cli/verbs/wire/topic_verb.hpp"
#include "console/bus_station.hpp"

namespace priamos::cli {
namespace {

constexpr int kPeriod_ms = 10;
constexpr int kPorts = 10;

struct ServeOptions : BusOptions {
  int port = 8765;
  std::vector<std::string> origins;
  bool json = false;
};

void Announce(const ServeOptions& options, const std::string& address) {
  if (options.json) {
    std::cout << JsonLine({{"address", address}}) << std::endl;
    return;
  }
  const std::string socket = "ws" + address.substr(std::string("http").size());
  std::cout << fmt::format("the bus is at {}, for Foxglove and Lichtblick at {} (Ctrl-C ends it)", address,
                           socket)
            << std::endl;
}

int Serve(const ServeOptions& options) {
  const bus::Schema schema = LoadTypes(options.types);
  const bus::HostClock clock;
  bus::LcmBus bus(options.bus.Url(), options.messages());
  WebServerOptions server;
  server.port = options.port;
  server.ports = kPorts;
  server.access.foxglove_origins = options.origins;
  console::BusStation station(schema, server);
  bus.SubscribeEverything([&](std::string_view channel, std::span<const std::byte> bytes) {
    const bus::Struct* type = schema.Of(bytes);
    if (type != nullptr && bus::Walk(*type, bytes)) station.Hear(std::string(channel), bytes, clock.Now());
  });
  Announce(options, station.address());
  const bus::SignalWatch signals;
  while (true) {
    pollfd fds[] = {{bus.fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}};
    poll(fds, std::size(fds), kPeriod_ms);
    if (fds[1].revents != 0) return 0;
    bus.Drain();
    station.Tick(clock.Now());
  }
}

}  // namespace

void AddTopicServeVerb(CLI::App& topic, int& exit_code) {
  auto options = std::make_shared<ServeOptions>();
  auto* verb = AddTopicVerb(topic, "serve", "Show a bus in a browser, and to Foxglove and Lichtblick.",
                            "priamos topic serve --bus udpm://239.255.76.67:7667 --types lcmtypes", *options);
  verb->add_option("--port", options->port, "first TCP port that is tried; 0: any")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  verb->add_option(
          "--origin", options->origins,
          "foreign page that may connect, https://app.foxglove.dev; file:// for the desktop programs")
      ->check([](const std::string& origin) {
        return IsOrigin(origin) ? "" : "expected https://HOST[:PORT], http://HOST[:PORT] or file://";
      });
  CompleteVerb(*verb, options, Serve, exit_code, "the address machine-readable");
}

}  // namespace priamos::cli
