#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/terminal/silence_watch.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "cli/verbs/wire/topic_verb.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

struct PubOptions : BusOptions {
  std::string channel, type;
  std::string message;  ///< JSON
  bool json = false;
};

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
void WarnOfUnknownChannel(const PubOptions& options, const std::string& channel) {
  const auto known = ChannelNames(false);
  if (!options.types.empty() || std::find(known.begin(), known.end(), channel) != known.end()) return;
  std::cerr << fmt::format(
      "priamos topic pub: \"{}\" is no channel of PRIAMOS{} (priamos type channels lists all)\n", channel,
      NearestText(channel, known));
}

int Pub(const PubOptions& options) {
  const bus::Schema schema = LoadTypes(options.types);
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

}  // namespace

void AddTopicPubVerb(CLI::App& topic, int& exit_code) {
  auto options = std::make_shared<PubOptions>();
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

}  // namespace priamos::cli
