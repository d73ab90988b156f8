#include "console/news_feed.hpp"

#include <utility>

#include "bus/schema/json.hpp"
#include "bus/schema/schema.hpp"
#include "console/core/valid_time.hpp"

namespace priamos::console {

void NewsFeed::Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival) {
  const bus::Struct* type = schema_.Of(bytes);
  if (type == nullptr) return;
  News::Json message = bus::ToJson(*type, bytes);
  const std::string key = KeyOf(channel, message, heard_[channel]++);
  const Time valid = ValidTime(message, arrival);
  news_.Put(key, channel, valid, std::move(message), type->full_name);
}

void NewsFeed::Forget() {
  news_ = {};
  heard_.clear();
}

}  // namespace priamos::console
