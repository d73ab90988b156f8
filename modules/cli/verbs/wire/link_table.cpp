#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bus/radio/budget.hpp"
#include "bus/radio/link_config.hpp"
#include "bus/schema/lcm_format.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "common/config.hpp"

namespace priamos::cli {
namespace {
using bus::radio::ChannelClass;

using bus::radio::Direction;
using bus::radio::LinkChannel;

std::int64_t TtlOf(const LinkChannel& c) {
  return c.channel_class == ChannelClass::kCommand ? c.ttl.count() : 0;
}

/// The initialisers of a `pr_channel` array of bus/radio/tiny.
std::string AsC(const bus::radio::ChannelTable& table) {
  constexpr const char* kClasses[] = {"PR_STATE", "PR_EVENT", "PR_COMMAND"};
  std::string text;
  for (const LinkChannel& c : table.channels()) {
    const bool delta = !c.delta.empty();
    text += fmt::format("{{\"{}\", 0x{:016x}, {}, {}, {}, {}, {}, {}, {}}},\n", c.name, c.fingerprint,
                        c.direction == Direction::kUp ? "PR_UP" : "PR_DOWN",
                        delta ? "PR_DELTA_STATE" : kClasses[static_cast<int>(c.channel_class)], c.fixed_bits,
                        c.max_bits, TtlOf(c), c.urgent ? "true" : "false",
                        delta ? fmt::format("\"{}\"", fmt::join(c.delta, ",")) : "0");
  }
  return text;
}

nlohmann::ordered_json AsJson(const bus::radio::LinkConfig& config, const bus::radio::ChannelTable& table,
                              const bus::Schema& types) {
  constexpr const char* kClasses[] = {"state", "event", "command"};
  nlohmann::ordered_json json{{"table_hash", fmt::format("{:08x}", table.hash())},
                              {"encrypted", table.encrypted()},
                              {"code_bytes", table.code_bytes()},
                              {"baud", config.baud},
                              {"bytes_per_s", config.BytesPerSecond()},
                              {"channels", nlohmann::json::array()}};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const LinkChannel& c = table.at(i);
    const bus::Struct& type = *types.Find(config.channels[i].type);
    json["channels"].push_back({{"name", c.name},
                                {"meaning", fmt::format("{:016x}", c.fingerprint)},
                                {"direction", NameOf(c.direction)},
                                {"class", kClasses[static_cast<int>(c.channel_class)]},
                                {"fixed_bits", c.fixed_bits},
                                {"max_bits", c.max_bits},
                                {"ttl_us", TtlOf(c)},
                                {"urgent", c.urgent},
                                {"on_request", c.on_request},
                                {"delta", c.delta},
                                {"type", type.full_name},
                                {"lcm", bus::FormatLcm(type)}});
  }
  return json;
}

/// The other ends are for a line of two directions: on another radio they would talk out of turn.
void RefuseOtherRadios(const bus::radio::LinkConfig& config) {
  struct Kind {
    bool is;
    const char *key, *got;
  };
  const std::array<Kind, 4> others{{{config.robots > 0, "robots", "one of several robots"},
                                    {config.half_duplex_turn_s > 0, "half_duplex_turn_s", "one with turns"},
                                    {config.medium != "bytes", "medium", "one of packets"},
                                    {config.datagrams, "datagrams", "one of datagrams"}}};
  for (const Kind& kind : others)
    if (kind.is)
      throw ConfigError(
          fmt::format("{}: expected a link of two ends over a line of two directions, which other "
                      "ends can join, got {}",
                      config.place.Of(kind.key), kind.got));
}

}  // namespace

void AddLinkTableVerb(CLI::App& link) {
  auto config = std::make_shared<std::string>();
  auto types = std::make_shared<std::vector<std::string>>();
  auto c = std::make_shared<bool>(false), json = std::make_shared<bool>(false);
  auto* verb = AddVerb(link, "table", "The channel table of a link.toml, for another end of the link.");
  verb->footer("Example: priamos link table config/sim/link.toml --c > channels.inc");
  verb->add_option("config", *config, "link.toml")->required();
  AddTypesOption(*verb, *types);
  auto* as_c = verb->add_flag("--c", *c, "as pr_channel initialisers of bus/radio/tiny");
  verb->add_flag("--json", *json, "machine-readable, as `python3 -m priamos_link` takes it")->excludes(as_c);
  verb->callback([=] {
    const auto link_config = LoadConfig<bus::radio::LinkConfig>(*config);
    RefuseOtherRadios(link_config);
    const bus::Schema schema = LoadTypes(*types);
    const bus::radio::ChannelTable table = link_config.Table(schema);
    RequireBudget(table, link_config.Options());  // the other end would not start with it
    if (*json)
      std::cout << AsJson(link_config, table, schema).dump(2) << "\n";
    else
      std::cout << (*c ? AsC(table) : fmt::format("{}hash {:08x}\n", table.Text(), table.hash()));
  });
}

}  // namespace priamos::cli
