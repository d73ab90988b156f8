#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/wire/multicast.hpp"
#include "bus/wire/network_interface.hpp"
#include "cli/terminal/topic_echo.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "cli/verbs/wire/topic_verb.hpp"

namespace priamos::cli {
namespace {

struct UrlOptions : BusOptions {
  bool json = false;
};

/// LCM's own programs know group, port and ttl; by which interface they send and listen is the route's
/// decision.
void ExplainNetwork(const std::string& url) {
  if (const std::string network = bus::NetworkOf(url); !network.empty())
    std::cerr << fmt::format(
        "priamos topic url: LCM's own programs cannot be told the network {}, they follow the route; next: "
        "sudo ip "
        "route add {}/32 dev {}\n",
        network, bus::GroupOf(url), bus::FindInterface(network).name);
}

int PrintUrl(const UrlOptions& options) {
  const std::string with_network = options.bus.Url(), url = bus::WithoutNetwork(with_network);
  ExplainNetwork(with_network);
  std::cout << (options.json ? nlohmann::ordered_json{{"url", url}}.dump() : url) << "\n";
  return 0;
}

void AddUrlVerb(CLI::App& topic, int& exit_code) {
  auto options = std::make_shared<UrlOptions>();
  auto* verb = AddTopicVerb(topic, "url", "Print the URL of a bus, for LCM's own programs.",
                            "priamos topic url --bus onboard", *options);
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code] { exit_code = PrintUrl(*options); });
}

}  // namespace

void AddTopicCommand(CLI::App& cli, int& exit_code) {
  auto* topic = AddVerb(cli, "topic", "See and send what is on a bus, of any type, without compiling it.");
  topic->require_subcommand(1);
  AddTopicTableVerbs(*topic, exit_code);
  AddTopicEchoVerb(*topic, exit_code);
  AddUrlVerb(*topic, exit_code);
  AddTopicPubVerb(*topic, exit_code);
  AddTopicServeVerb(*topic, exit_code);
}

}  // namespace priamos::cli
