#include "console/core/news.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "console/core/json_line.hpp"

namespace priamos::console {
namespace {

constexpr std::uint64_t kKeptAlarms = 50;

std::string TextOf(const News::Json& message, const char* field) {
  const auto it = message.find(field);
  return it == message.end() ? "" : JsonLine(*it);
}

}  // namespace

void News::Put(const std::string& key, const std::string& channel, Time valid, Json message,
               std::string type) {
  if (!items_.contains(key) && items_.size() >= kMostKeys) return;
  items_[key] = {key, channel, valid, std::move(message), std::move(type), ++newest_};
}

std::vector<const News::Item*> News::Since(std::uint64_t number) const {
  std::vector<const Item*> found;
  for (const auto& [key, item] : items_)
    if (item.number > number) found.push_back(&item);
  std::sort(found.begin(), found.end(), [](const Item* a, const Item* b) { return a->number < b->number; });
  return found;
}

std::string KeyOf(const std::string& channel, const News::Json& message, std::uint64_t count) {
  if (channel == "HEALTH" || channel == "PROCESS_STATE")
    return fmt::format("{} {}", channel, TextOf(message, "process"));
  if (channel == "LINK_STATUS")
    return fmt::format("{} {} {}", channel, TextOf(message, "onboard"), TextOf(message, "first_channel"));
  if (channel == "LANDMARK_MODEL") return fmt::format("{} {}", channel, TextOf(message, "landmark_id"));
  if (channel == "DOOR_FOUND" || channel == "SCENE_OBJECT")
    return fmt::format("{} {}", channel, TextOf(message, "id"));
  if (channel == "FLOOR_MAP") return fmt::format("{} {}", channel, TextOf(message, "part"));
  if (channel == "DOOR_SEEN") return fmt::format("{} {}", channel, TextOf(message, "landmark_id"));
  if (channel == "PROCESS_REPORT") return fmt::format("{} {}", channel, TextOf(message, "name"));
  if (channel == "ALARM" || channel == "ALARM_ACK") return fmt::format("{} {}", channel, count % kKeptAlarms);
  return channel;
}

}  // namespace priamos::console
