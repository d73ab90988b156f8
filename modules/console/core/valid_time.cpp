#include "console/core/valid_time.hpp"

#include <nlohmann/json.hpp>

namespace priamos::console {

Time ValidTime(const nlohmann::ordered_json& message, Time arrival) {
  constexpr Duration kLongestAge = std::chrono::seconds(120);
  if (!message.is_object()) return arrival;
  for (const char* field : {"utime", "utime_exposure"}) {
    const auto it = message.find(field);
    if (it == message.end() || !it->is_number_integer()) continue;
    const std::int64_t utime = it->get<std::int64_t>(), now = ToUtime(arrival);
    if (utime <= now && utime >= now - kLongestAge.count()) return FromUtime(utime);
  }
  return arrival;
}

}  // namespace priamos::console
