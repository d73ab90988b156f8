#include <nlohmann/json.hpp>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "cli/terminal/link_top.hpp"

namespace priamos::cli {
namespace {

nlohmann::ordered_json OrNull(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

/// The newest report, with all channels of the link instead of those it brought.
nlohmann::ordered_json LinkTopView::Json(Time now) const {
  if (!last_) return {{"heard", false}};
  const bus::Schema schema = bus::OwnTypes();
  nlohmann::ordered_json json{{"heard", true}, {"age_s", Seconds(now - last_at_)}};
  json.update(bus::ToJson(*schema.Find("priamos.link_status_t"), bus::Encode(*last_)));
  for (const char* key : {"first_channel", "n_channels"}) json.erase(key);
  json["channels"] = nlohmann::ordered_json::array();
  for (const auto& [number, row] : rows_) {
    const link_channel_t& c = row.channel;
    json["channels"].push_back({{"channel", c.channel},
                                {"outgoing", c.outgoing != 0},
                                {"messages_per_s", OrNull(row.messages_per_s)},
                                {"bytes_per_s", OrNull(row.bytes_per_s)},
                                {"messages", c.messages},
                                {"bytes", c.bytes},
                                {"replaced", c.replaced},
                                {"dropped", c.dropped},
                                {"expired", c.expired},
                                {"refused", c.dropped - c.expired},
                                {"unwanted", c.unwanted},
                                {"late", c.late},
                                {"saturated", c.saturated},
                                {"queue_age_s", c.queue_age_s}});
  }
  return json;
}

}  // namespace priamos::cli
