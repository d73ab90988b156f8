#include "cli/verbs/wire/channel_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "bus/own_types.hpp"
#include "bus/schema/packing.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

/// Calls `use(channel, its type)` for every channel.
template <class Use>
void ForEachChannel(const Use& use) {
  const bus::Schema schema = bus::OwnTypes();
  const auto one = [&]<class T>(const Channel<T>& channel) {
    use(channel, *schema.Find(static_cast<std::uint64_t>(T::getHash())));
  };
  std::apply([&](const auto&... channel) { (one(channel), ...); }, channels::kAll);
}

}  // namespace

std::string ChannelTable() {
  std::string table =
      "| channel | type | rate | stale after | bytes on LCM, at most | packed |\n"
      "|---|---|---|---|---|---|\n";
  ForEachChannel([&](const auto& channel, const bus::Struct& type) {
    const bool event = channel.rate_hz == 0;
    table += fmt::format("| {} | {} | {} | {} | {} | {} |\n", channel.name, type.name,
                         event ? "event" : fmt::format("{} Hz", channel.rate_hz),
                         event ? "" : fmt::format("{} ms", channel.stale_after.count()),
                         bus::MaxEncodedSize(type).value(), bus::Packer(type).MaxBytes());
  });
  return table;
}

std::string ChannelsAsJson() {
  auto all = nlohmann::ordered_json::array();
  ForEachChannel([&](const auto& channel, const bus::Struct& type) {
    all.push_back({{"channel", channel.name},
                   {"type", type.full_name},
                   {"rate_hz", channel.rate_hz},
                   {"stale_after_ms", channel.stale_after.count()},
                   {"max_bytes", bus::MaxEncodedSize(type).value()},
                   {"max_packed_bytes", bus::Packer(type).MaxBytes()}});
  });
  return all.dump();
}

}  // namespace priamos::cli
